#!/usr/bin/env python3
"""Wrong arguments of the example driver and of the conformance suite: one clear message each, exit 2.

    test/server/driver_inputs.py ARMLOOM
"""
import pathlib
import subprocess
import sys
import tempfile

from killed_server import ROOT

DRIVERS = ROOT / "server/arm_process"


def main():
    hello = subprocess.run([sys.argv[1], "arm", "--cell", str(ROOT / "config/two_pandas_remote.json"), "--robot", "left",
                            "--hello"], check=True, capture_output=True, text=True).stdout
    with tempfile.TemporaryDirectory(prefix="armloom-inputs-") as folder:
        good, bad, empty = (pathlib.Path(folder) / name for name in ("left.json", "bad.json", "empty.json"))
        good.write_text(hello)
        bad.write_text('{"type": "hello"}')
        empty.write_text(hello.split('"arms"')[0] + '"arms": [], ' + hello.split("}]}],")[1])
        place = f"unix:{folder}/left.sock"
        faults = 0
        for script, arguments, said in [
                ("example_driver.py", [place, good, "[0]"], "expected an object with positions of the arms left"),
                ("example_driver.py", [place, good, '{"right": [0]}'], "expected an object with positions of the arms left"),
                ("example_driver.py", [place, good, '{"left": [0]}'], "left: expected a list of 8 numbers"),
                ("example_driver.py", [place, good, '{"left": ["0", 0, 0, 0, 0, 0, 0, 0]}'], "expected a list of 8 numbers"),
                ("example_driver.py", [place, good, "{"], "positions at the start: "),
                ("example_driver.py", [place, bad], "bad.json: hello has wrong members"),
                ("example_driver.py", [f"unix:{good}", good], "Address already in use"),
                ("example_driver.py", ["left.sock", good], "expected unix:PATH or tcp:HOST:PORT"),
                ("conformance.py", [place, bad], "bad.json: is no hello; write the file with `armloom arm"),
                ("conformance.py", [place, empty], "empty.json: has no arms"),
                ("conformance.py", [place, f"{folder}/none"], "No such file"),
                ("conformance.py", [place, good], "left.sock: no connection to a driver: "),
                ("conformance.py", ["left.sock", good], "expected unix:PATH or tcp:HOST:PORT")]:
            ended = subprocess.run([sys.executable, str(DRIVERS / script), *map(str, arguments)], capture_output=True,
                                   text=True, timeout=60)
            is_right = ended.returncode == 2 and said in ended.stderr and ended.stderr.count("\n") == 1 and not ended.stdout
            faults += not is_right
            if not is_right:
                print(f"{script} {arguments}: {ended}")
        assert good.read_text() == hello, "the driver removed a file that is no socket"
        print(f"{faults} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
