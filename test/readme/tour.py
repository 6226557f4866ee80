#!/usr/bin/env python3
"""Executes the examples of the README and of the server's as they stand: "Your own robot" and those
with curl, comparing what comes back.

    test/readme/tour.py ARMLOOM

Each ```sh block is run in one and the same shell; the ```json block behind it lists what must be
in the answers, one JSON value for each answer: every key shown must be there with that value ("…"
stands for any value). The server is started on the README's port, in a network of its own where
that is possible, so that nothing else can be listening there.
"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time
import urllib.request

TOP = pathlib.Path(__file__).resolve().parents[2]
MARK = "==== end of block ===="


def blocks(readme, heading):
    """The (commands, expected values) of a section, in order."""
    tour = readme.split(f"## {heading}\n")[1].split("\n## ")[0]
    found = re.findall(r"```sh\n(.*?)```\n```json\n(.*?)```", tour, re.S)
    return [(commands, list(values(expected))) for commands, expected in found]


def values(text):
    decoder, at = json.JSONDecoder(), 0
    while text[at:].strip():
        at += len(text[at:]) - len(text[at:].lstrip())
        value, at = decoder.raw_decode(text, at)
        yield value


def difference(expected, got, place=""):
    """The first place at which `got` lacks something of `expected`, or None."""
    if expected == "…":
        return None if got is not None else f"{place}: nothing there"
    if isinstance(expected, dict) and isinstance(got, dict):
        for key, value in expected.items():
            if key not in got:
                return f"{place}/{key}: missing"
            if found := difference(value, got[key], f"{place}/{key}"):
                return found
        return None
    if isinstance(expected, list) and isinstance(got, list):
        if len(expected) != len(got):
            return f"{place}: {len(got)} values, expected {len(expected)}"
        pairs = enumerate(zip(expected, got))
        return next((d for i, (e, g) in pairs if (d := difference(e, g, f"{place}/{i}"))), None)
    same = abs(expected - got) < 1e-9 if isinstance(expected, (int, float)) and \
        isinstance(got, (int, float)) and not isinstance(expected, bool) else expected == got
    return None if same else f"{place}: {got!r}, expected {expected!r}"


def own_robot(readme, armloom):
    """Runs "Your own robot in five minutes" with its cell file in a folder of its own, and serves it."""
    commands = readme.split("## Your own robot in five minutes")[1].split("```sh\n")[1].split("```")[0]
    importing, serving = commands.split("./server/run --cell my_cell.json\n")
    if serving:
        sys.exit(f"own robot: something stands behind the last command: {serving}")
    with tempfile.TemporaryDirectory() as folder:
        cell = pathlib.Path(folder) / "my_cell.json"
        importing = importing.replace("build/armloom", str(armloom)).replace("my_cell.json", str(cell))
        done = subprocess.run(["bash", "-ec", importing], cwd=TOP, capture_output=True, text=True)
        if done.returncode != 0:
            print(f"own robot: FAIL exit {done.returncode}\n{done.stderr}")
            return 1
        server = subprocess.Popen([armloom, "serve", "--cell", cell], stdout=subprocess.DEVNULL)
        try:
            wait_until_up(server)
            arms = json.load(urllib.request.urlopen("http://127.0.0.1:8080/api/v1/arms"))["arms"]
        finally:
            server.terminate()
            server.wait(timeout=10)
    found = [(arm["name"], arm["state"]) for arm in arms]
    good = found == [("left", "idle"), ("right", "idle")]
    print(f"own robot: {'ok' if good else 'FAIL'} {found}")
    return 0 if good else 1


def wait_until_up(server):
    for _ in range(200):
        if server.poll() is not None:
            sys.exit(f"the server ended with {server.returncode}")
        try:
            urllib.request.urlopen("http://127.0.0.1:8080/healthz", timeout=1)
            return
        except OSError:
            time.sleep(0.1)
    sys.exit("the server did not come up")


def run_tour(tour):
    shell = subprocess.Popen(["bash"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    failed = 0
    for number, (commands, expected) in enumerate(tour, start=1):
        shell.stdin.write(f"{commands}\necho; echo '{MARK}'\n")
        shell.stdin.flush()
        output = ""
        while MARK not in output:
            output += shell.stdout.readline()
        got = list(values(output.split(MARK)[0]))
        found = difference(expected, got)
        print(f"block {number}: {'ok' if not found else 'FAIL ' + found}")
        if found:
            print(f"{commands}\n{output}")
            failed += 1
    shell.stdin.close()
    shell.wait(timeout=10)
    return failed


def main():
    # A network of its own: loopback only, nobody else on the README's port.
    if "ARMLOOM_TOUR_INSIDE" not in os.environ and os.geteuid() == 0 and shutil.which("unshare"):
        inside = ["unshare", "-n", "sh", "-c", 'ip link set lo up && exec "$@"', "sh",
                  sys.executable, *sys.argv]
        probe = subprocess.run(["unshare", "-n", "ip", "link", "set", "lo", "up"],
                               capture_output=True)
        if probe.returncode == 0:
            os.execvpe("unshare", inside, dict(os.environ, ARMLOOM_TOUR_INSIDE="1"))
    readme = (TOP / "README.md").read_text()
    api = (TOP / "server/README.md").read_text()
    tour = blocks(readme, "A tour with curl") + blocks(api, "The API")
    if len(tour) < 13:
        sys.exit(f"only {len(tour)} blocks found in the READMEs")
    failed = own_robot(readme, sys.argv[1])
    server = subprocess.Popen([sys.argv[1], "serve", "--cell", TOP / "config/two_pandas.json"],
                              stdout=subprocess.DEVNULL)
    try:
        wait_until_up(server)
        failed += run_tour(tour)
    finally:
        server.terminate()
        server.wait(timeout=10)
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
