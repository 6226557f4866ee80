#!/usr/bin/env python3
"""Runs the result of `cmake --install` from its prefix, like its systemd unit.

    installed.py --cmake CMAKE --build DIR --prefix DIR --version V

The unit's command, with the settings of etc/armloom/server.conf, must serve the dashboard and accept a job.
After SIGTERM during a motion it must exit within two seconds, and the next server must know the job.
"""
import argparse
import json
import os
import pathlib
import re
import shlex
import shutil
import signal
import string
import subprocess
import sys
import time
import urllib.request

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "server"))
from killed_server import swing  # noqa: E402


def settings(file):
    lines = [line for line in file.read_text().splitlines() if line and not line.startswith("#")]
    return dict(line.split("=", 1) for line in lines)


def command(prefix):
    """Expands variables like systemd: ${NAME} is one word, $NAME is split into words."""
    unit = (prefix / "lib/systemd/system/armloom.service").read_text()
    environment = settings(prefix / "etc/armloom/server.conf")
    environment["ARMLOOM_LISTEN"] = "127.0.0.1:0"
    line = re.search(r"^ExecStart=(.*)$", unit, re.M)[1]
    return shlex.split(string.Template(line).substitute({"ARMLOOM_OPTIONS": ""} | environment))


class Running:
    def __init__(self, words):
        self.process = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        line = self.process.stdout.readline()
        if "dashboard" not in line:
            sys.exit(f"{words} did not come up: {self.process.stderr.read()}")
        self.base = line.split(" ", 1)[1].strip().rstrip("/")

    def get(self, path, body=None):
        request = urllib.request.Request(self.base + path, body and json.dumps(body).encode(),
                                         {"Content-Type": "application/json"})
        with urllib.request.urlopen(request, timeout=20) as answer:
            return answer.read().decode()

    def job(self, name):
        return json.loads(self.get("/api/v1/jobs/" + name))

    def end(self):
        begun = time.monotonic()
        self.process.send_signal(signal.SIGTERM)
        assert self.process.wait(20) == 0, self.process.stderr.read()
        took = time.monotonic() - begun
        assert took < 2, f"{took:.1f} s after SIGTERM"
        return took


def main():
    parser = argparse.ArgumentParser()
    for name in ("cmake", "build", "prefix", "version"):
        parser.add_argument("--" + name, required=True)
    asked = parser.parse_args()
    prefix = pathlib.Path(asked.prefix)
    shutil.rmtree(prefix, ignore_errors=True)
    subprocess.run([asked.cmake, "--install", asked.build, "--prefix", prefix], check=True,
                   stdout=subprocess.DEVNULL)
    said = subprocess.run([prefix / "bin/armloom", "--version"], check=True, capture_output=True, text=True)
    assert said.stdout == f"armloom {asked.version}\n", said
    words = command(prefix)
    os.makedirs(settings(prefix / "etc/armloom/server.conf")["ARMLOOM_DATA"])  # systemd: StateDirectory

    first = Running(words)
    first.get("/readyz")
    if (prefix / "share/armloom/web").is_dir():
        assert "<script" in first.get("/"), "the dashboard is not served"
    first.get("/api/v1/jobs", swing("go", "left", 4, []))
    deadline = time.monotonic() + 20
    while first.job("go")["state"] != "running":
        assert time.monotonic() < deadline, first.job("go")
    took = first.end()

    second = Running(words)
    assert second.job("go")["state"] == "interrupted", second.job("go")
    second.end()
    print(f"served from {prefix}; {took:.2f} s from SIGTERM in a motion to the end")
    shutil.rmtree(prefix)


if __name__ == "__main__":
    main()
