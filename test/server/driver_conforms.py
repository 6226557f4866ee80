#!/usr/bin/env python3
"""Runs the conformance suite for drivers (server/arm_process/conformance.py) on one driver.

    test/server/driver_conforms.py ARMLOOM armloom|physics|python [--only CHECK ...]
"""
import contextlib
import json
import pathlib
import subprocess
import sys
import tempfile

from killed_server import HOME, ROOT

CELL = ROOT / "config/two_pandas_remote.json"
DRIVERS = ROOT / "server/arm_process"


@contextlib.contextmanager
def running(program, driver, drivers=DRIVERS):
    """Starts a driver; gives its endpoint and the hello that fits it. `drivers`: folder of the driver in Python."""
    with tempfile.TemporaryDirectory(prefix="armloom-driver-") as folder:
        endpoint, hello = f"unix:{folder}/right.sock", pathlib.Path(folder) / "hello.json"
        terms = subprocess.run([program, "arm", "--cell", str(CELL), "--robot", "right", "--hello"],
                               check=True, capture_output=True, text=True).stdout
        # A busy machine is late, so the timeout is long.
        hello.write_text(json.dumps({**json.loads(terms), "timeout_s": 2.0}))
        command = [program, "arm", "--cell", str(CELL), "--robot", "right", "--listen", endpoint]
        if driver == "physics":
            command.append("--physics")
        elif driver == "python":
            command = [sys.executable, str(drivers / "example_driver.py"), endpoint, str(hello),
                       json.dumps({"right": HOME + [0.0]})]
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
            try:
                process.stdout.readline()
                yield endpoint, hello
            finally:
                process.terminate()


def conforms(endpoint, hello, *options, **how):
    return subprocess.run([sys.executable, str(DRIVERS / "conformance.py"), endpoint, str(hello), *options], **how)


def main():
    program, driver, *options = sys.argv[1:]
    with running(program, driver) as (endpoint, hello):
        return conforms(endpoint, hello, *options).returncode


if __name__ == "__main__":
    sys.exit(main())
