#!/usr/bin/env python3
"""Runs the conformance suite for drivers (server/arm_process/conformance.py) on one driver.

    test/server/driver_conforms.py ARMLOOM armloom|physics|python
"""
import json
import pathlib
import subprocess
import sys
import tempfile

from killed_server import HOME, ROOT

CELL = ROOT / "config/two_pandas_remote.json"


def main():
    program, driver = sys.argv[1:]
    with tempfile.TemporaryDirectory(prefix="armloom-driver-") as folder:
        endpoint = f"unix:{folder}/right.sock"
        hello = subprocess.run([program, "arm", "--cell", str(CELL), "--robot", "right", "--hello"],
                               check=True, capture_output=True, text=True).stdout
        # A busy machine is late, so the timeout is long.
        (pathlib.Path(folder) / "hello.json").write_text(json.dumps({**json.loads(hello), "timeout_s": 0.5}))
        command = {"armloom": [program, "arm", "--cell", str(CELL), "--robot", "right", "--listen", endpoint],
                   "physics": [program, "arm", "--cell", str(CELL), "--robot", "right", "--listen", endpoint, "--physics"],
                   "python": [sys.executable, str(ROOT / "server/arm_process/example_driver.py"), endpoint,
                              json.dumps({"right": HOME + [0.0]})]}[driver]
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
            try:
                process.stdout.readline()
                return subprocess.run([sys.executable, str(ROOT / "server/arm_process/conformance.py"), endpoint,
                                       folder + "/hello.json"]).returncode
            finally:
                process.terminate()


if __name__ == "__main__":
    sys.exit(main())
