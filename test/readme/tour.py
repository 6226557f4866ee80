#!/usr/bin/env python3
"""Executes every ```sh block of README.md and server/README.md unchanged.

    test/readme/tour.py ARMLOOM

"Your own robot" and "Without a server" run in a folder with build/armloom and the repository's folders;
each command must succeed. All blocks with curl run in one shell. The ```json block after each block lists
expected answers, one JSON value per answer: every key shown must have that value ("…" matches any value).
Servers listen on a free port, and the address on the page is replaced by theirs.
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import threading
import urllib.request

TOP = pathlib.Path(__file__).resolve().parents[2]
MARK = "==== end of block ===="
ADDRESS = "http://127.0.0.1:8080/"  # in the READMEs


def blocks(readme, heading):
    """Returns the (commands, expected values) of a section, in order."""
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
    """Returns the first place at which `got` lacks a part of `expected`, or None."""
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


def commands_of(readme, heading):
    return readme.split(f"## {heading}\n")[1].split("```sh\n")[1].split("```")[0]


def like_a_clone(folder, armloom):
    """Links what the commands of a README use: the repository's folders, and the program in build/."""
    for part in ("models", "config"):
        (folder / part).symlink_to(TOP / part)
    (folder / "build").mkdir()
    (folder / "build/armloom").symlink_to(pathlib.Path(armloom).resolve())


def run_block(name, commands, folder):
    done = subprocess.run(["bash", "-ec", commands], cwd=folder, capture_output=True, text=True)
    print(f"{name}: {'ok' if done.returncode == 0 else 'FAIL'} exit {done.returncode}")
    if done.returncode != 0:
        print(done.stdout[-2000:], done.stderr[-2000:])
    return done.returncode == 0


def own_robots(readme, armloom, folder):
    """Imports and serves the robot of the README, and the second robot that it names, if present."""
    section = readme.split("## Your own robot\n")[1].split("\n## ")[0]
    importing, serving = commands_of(readme, "Your own robot").split(
        "./server/run --cell my_cell.json\n")
    if serving:
        sys.exit(f"own robot: something stands behind the last command: {serving}")
    failed = own_robot("own robot", importing, armloom, folder)
    shown, other = re.search(r"^R=(.*)$", importing, re.M), re.search(r"`R=(.*?)`", section)
    if not shown or not other:
        sys.exit("own robot: its files are not named by R=...")
    if not (TOP / f"{other[1]}.urdf").exists():
        print(f"SKIP another robot: there is no {other[1]}.urdf here")
        return failed
    importing = importing.replace(shown[0], f"R={TOP / other[1]}")
    return failed + own_robot("another robot", importing, armloom, folder)


def own_robot(name, importing, armloom, folder):
    (folder / "my_cell.json").unlink(missing_ok=True)
    if not run_block(name, importing, folder):
        return 1
    with Server(armloom, folder / "my_cell.json") as url:
        arms = json.load(urllib.request.urlopen(f"{url}api/v1/arms"))["arms"]
    found = [(arm["name"], arm["state"]) for arm in arms]
    good = found == [("left", "idle"), ("right", "idle")]
    print(f"{name} is served: {'ok' if good else 'FAIL'} {found}")
    return 0 if good else 1


def without_a_server(readme, folder):
    done = run_block("without a server", commands_of(readme, "Without a server"), folder)
    written = [name for name in ("recording/states.csv", "compared/compare.svg")
               if not (folder / name).exists()]
    if written:
        print(f"without a server: FAIL not written: {written}")
    return 0 if done and not written else 1


class Server:
    """Serves a cell; as a context manager it returns the dashboard's address once the server listens."""

    def __init__(self, armloom, cell):
        self.process = subprocess.Popen([armloom, "serve", "--cell", cell, "--listen", "127.0.0.1:0"],
                                        stdout=subprocess.PIPE, text=True)

    def __enter__(self):
        for line in self.process.stdout:
            if found := re.search(r"dashboard: (http://\S+/)", line):
                threading.Thread(target=self.process.stdout.read, daemon=True).start()
                return found[1]
        sys.exit(f"the server ended with {self.process.wait()}")

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait(timeout=10)


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


def reasons_are_explained(readme, url):
    """Checks that the README lists every result.reason, with an explanation."""
    document = json.load(urllib.request.urlopen(f"{url}openapi.json"))
    explained = (TOP / "core/scheduler/README.md").read_text()
    reasons = document["components"]["schemas"]["Reason"]["enum"]
    lost = [r for r in reasons if f"`{r}`" not in readme or f"| `{r}` |" not in explained]
    print(f"result.reason: {'ok' if not lost and len(reasons) >= 10 else f'FAIL {lost} of {reasons}'}")
    return 1 if lost or len(reasons) < 10 else 0


def main():
    readme = (TOP / "README.md").read_text()
    api = (TOP / "server/README.md").read_text()
    tour = blocks(readme, "Example: a blocked job") + blocks(api, "A tour with curl") + blocks(api, "The API")
    shown = readme.count("```sh\n") + api.count("```sh\n")
    if len(tour) + 2 != shown or shown < 14:  # two blocks have no JSON answer
        sys.exit(f"{len(tour)} of {shown} blocks found in the READMEs")
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        like_a_clone(folder, sys.argv[1])
        failed = own_robots(readme, sys.argv[1], folder) + without_a_server(readme, folder)
    if ADDRESS not in "".join(commands for commands, _ in tour):
        sys.exit(f"no block names {ADDRESS}")
    with Server(sys.argv[1], TOP / "config/pick_and_place.json") as url:
        here = [(commands.replace(ADDRESS, url), expected) for commands, expected in tour]
        failed += run_tour(here) + reasons_are_explained(readme, url)
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
