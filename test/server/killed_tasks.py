#!/usr/bin/env python3
"""Kills the server (kill -9) in each step of a pick and place, and checks the state that the next server restores.

    test/server/killed_tasks.py ARMLOOM

After each kill
- the job is `interrupted`, and names a step that it had begun (the last one that was stored: a step is stored
  some milliseconds after it began),
- the part is at exactly one place: held from `attach` to `detach`, at its last place otherwise. This is stored before
  the next step begins,
- nothing is done again: the job does not run.

Also kills the server
- while both hands hold a bar: both still hold it afterwards, and move only together,
- while the left hand holds the part, and starts once with a cell file without the left robot: the next server with the
  right cell file still knows that the hand holds the part,
- while a hand, of a robot that stays where it is, is at the bar on the table: before the bar is attached, while it is
  attached, and after it is detached. The arm does not leave by itself. A job that waits for this names the steps with
  which the arm may leave, and a job that begins with them succeeds.
"""
import contextlib
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import time

from killed_server import API, ROOT, Server

PART = {"name": "part", "box": [0.04, 0.04, 0.08], "xyz": [-0.1, 0.35, 0.141]}
ATTACH, DETACH = 4, 8


def above(y, z):
    pose = {"link": "left_panda_hand", "xyz": [-0.1, y, z], "rpy": [3.14159265, 0, 0.785]}
    return {"move_to": {"pose": pose}, "arm": "left"}


STEPS = [
    above(0.35, 0.40),
    {"gripper": {"arm": "left", "width_m": 0.07}},
    above(0.35, 0.25),
    {"gripper": {"arm": "left", "width_m": 0.04}},
    {"attach": {"object": "part", "link": "left_panda_hand", "touch": ["table"]}},
    above(0.35, 0.40),
    {"wait_s": 1.0},
    above(-0.35, 0.25),
    {"detach": {"object": "part", "touch": ["table"]}},
    {"gripper": {"arm": "left", "width_m": 0.07}},
    above(-0.35, 0.40),
]


def wait_for(what, found, seconds=60):
    until = time.monotonic() + seconds
    while time.monotonic() < until:
        answer = found()
        if answer is not None:
            return answer
        time.sleep(0.002)
    raise AssertionError(f"{what}: not within {seconds} s")


def kill_at(program, step, folder, log):
    """Kills the server once the job has come to this step. Returns the step that was seen last."""
    server = Server(program, folder, log)
    try:
        assert server.call("PUT", API + "/scene/objects/part", PART)[0] == 201
        status, answer = server.call("POST", API + "/jobs", {"id": "pick", "steps": STEPS})
        assert status == 202, answer

        def there():
            job = server.call("GET", API + "/jobs/pick")[1]
            assert job["state"] not in ("failed", "expired"), job["result"]
            at = job.get("step", len(STEPS))
            return at if at >= step and (job["started_s"] is not None or step == 0) else None

        return wait_for(f"step {step}", there)
    finally:
        server.kill()


def check(program, at, folder, log):
    server = Server(program, folder, log)
    try:
        job = server.call("GET", API + "/jobs/pick")[1]
        scene = server.call("GET", API + "/scene")[1]
        placed = [o for o in scene["objects"] if o["name"] == "part"]
        held = [h for h in scene["held"] if h["object"]["name"] == "part"]
        assert len(placed) + len(held) == 1, scene
        if job["state"] == "queued":  # it was killed before the job began
            assert at == 0, (at, job)
            return "waits"
        assert job["state"] == "interrupted", job
        ended = job["result"]["step"]
        assert ended <= at + 1, (at, job["result"])
        if ATTACH < at < DETACH - 1:
            assert held, (at, scene)
        elif at < ATTACH - 1:
            assert placed and abs(placed[0]["xyz"][1] - 0.35) < 1e-6, (at, scene)
        elif at > DETACH:
            assert placed and abs(placed[0]["xyz"][1] + 0.35) < 2e-3, (at, scene)
        status, answer = server.call("POST", API + "/resume")
        assert status < 300, answer
        time.sleep(0.5)
        assert server.call("GET", API + "/jobs/pick")[1]["state"] == "interrupted"
        return f"interrupted at step {ended}, part {'held' if held else 'placed'}"
    finally:
        server.kill()


def check_another_cell(program, folder, log):
    data = pathlib.Path(folder) / "data"
    kill_at(program, ATTACH + 2, data, log)
    text = re.sub(r"^ *//.*$", "", (ROOT / "config/two_pandas.json").read_text(), flags=re.MULTILINE)
    cell = json.loads(text.replace('"../models', f'"{ROOT}/models'))
    cell["robots"] = [robot for robot in cell["robots"] if robot["name"] == "right"]
    cell.pop("allowed_collisions", None)
    without_left = pathlib.Path(folder) / "right.json"
    without_left.write_text(json.dumps(cell))
    server = Server(program, data, log, cell=without_left)
    try:
        texts = [alert["text"] for alert in server.call("GET", API + "/alerts")[1]["alerts"]]
        assert any('"part" cannot be restored' in text and "is kept until" in text for text in texts), texts
    finally:
        server.kill()
    server = Server(program, data, log)
    try:
        held = server.call("GET", API + "/scene")[1]["held"]
        assert [h["object"]["name"] for h in held] == ["part"] and held[0]["arm"] == "left", held
    finally:
        server.kill()


def handover_with_both_hands():
    """Returns the steps of the handover in config/, in which both hands hold the bar for a while."""
    jobs = json.loads((ROOT / "config/pick_and_place_jobs.json").read_text())
    steps = next(job["job"]["steps"] for job in jobs if job["job"]["id"] == "hand-over-there")
    take = next(i for i, step in enumerate(steps) if step.get("attach", {}).get("link") == "right_panda_hand")
    steps[take]["attach"]["shared"] = True
    steps[take + 1:take + 1] = [{"wait_s": 60}, {"detach": {"object": "bar", "link": "left_panda_hand"}}]
    return steps


def check_both_hands(program, folder, log):
    cell = "pick_and_place.json"
    server = Server(program, folder, log, cell=cell)

    def held():
        return server.call("GET", API + "/scene")[1]["held"]

    try:
        status, answer = server.call("POST", API + "/jobs", {"id": "bar", "steps": handover_with_both_hands()})
        assert status == 202, answer
        wait_for("both hands", lambda: True if held() and "shared_with" in held()[0] else None)
        time.sleep(0.2)  # until it is stored
    finally:
        server.kill()
    server = Server(program, folder, log, cell=cell)
    try:
        [bar] = held()
        assert bar["arm"] == "left", bar
        assert bar["shared_with"] == [{"link": "right_panda_hand", "arm": "right"}], bar
        assert server.call("GET", API + "/jobs/bar")[1]["state"] == "interrupted"
        for path, body in (("/plan", {"arm": "left", "to": {"named": "ready"}}),
                           ("/jobs", {"arm": "right", "move_to": {"named": "ready"}})):
            status, answer = server.call("POST", API + path, body)
            assert status == 409 and answer["type"].endswith("moves-alone"), answer
        assert server.call("POST", API + "/scene/objects/bar/detach")[0] == 200
        assert not held()
    finally:
        server.kill()


def bar_at(z):
    pose = {"link": "left_panda_hand", "xyz": [-0.15, 0.4, z], "rpy": [3.1416, 0, 0]}
    return {"move_to": {"pose": pose}, "arm": "left"}


AT_BAR = [bar_at(0.5), {"gripper": {"arm": "left", "width_m": 0.07}}, bar_at(0.345),
          {"gripper": {"arm": "left", "width_m": 0.03}}]
TAKE_BAR = {"attach": {"object": "bar", "link": "left_panda_hand", "touch": ["table"]}}
PUT_BAR = {"detach": {"object": "bar", "touch": ["table"]}}
LEAVE = [{"gripper": {"arm": "left", "width_m": 0.07}}, bar_at(0.5)]
STAY = {"wait_s": 60}
# By name: the steps until the kill and after it; the steps with which the arm may leave; the text that names them.
LEFT_AT_BAR = {
    "before attach": ([*AT_BAR, STAY, TAKE_BAR, *LEAVE], [TAKE_BAR, PUT_BAR],
                      "if the hand is at bar, begin with an attach and a detach step"),
    "attached": ([*AT_BAR, TAKE_BAR, STAY, *LEAVE], [PUT_BAR], "if bar rests there, begin with a detach step"),
    "detached": ([*AT_BAR, TAKE_BAR, PUT_BAR, STAY, *LEAVE], [TAKE_BAR, PUT_BAR],
                 "if the hand is at bar, begin with an attach and a detach step"),
}


@contextlib.contextmanager
def robots_that_stay(program, folder, log):
    """Yields the cell file of config/pick_and_place.json with robots in processes of their own."""
    names = iter(("left", "right"))

    def remote(_):
        endpoint = f"unix:{folder}/{next(names)}.sock"
        controller = {"type": "remote", "endpoint": endpoint, "feedback_period_s": 0.004, "feedback_timeout_s": 0.8}
        return f'"controller": {json.dumps(controller)}'

    text = (ROOT / "config/pick_and_place.json").read_text().replace('"../models', f'"{ROOT}/models')
    cell = pathlib.Path(folder) / "cell.json"
    cell.write_text(re.sub(r'"controller": \{"type": "sim"[^}]*\}', remote, text))
    robots = []
    try:
        for name in ("left", "right"):
            robots.append(subprocess.Popen(
                [program, "arm", "--cell", str(cell), "--robot", name, "--listen", f"unix:{folder}/{name}.sock"],
                stdout=log, stderr=log))
        yield cell
    finally:
        for robot in robots:
            robot.kill()
            robot.wait()


def check_arm_leaves(program, name, folder, log):
    steps, leaves, text = LEFT_AT_BAR[name]

    def job(server, key, holds, body=None):
        if body is not None:
            status, answer = server.call("POST", API + "/jobs", {"id": key, "steps": body})
            assert status == 202, answer
        return wait_for(f"{name}: {key}", lambda: holds(server.call("GET", API + f"/jobs/{key}")[1]))

    def has_succeeded(view):
        assert view["state"] not in ("failed", "expired"), view
        return view["state"] == "succeeded" or None

    with robots_that_stay(program, folder, log) as cell:
        data = pathlib.Path(folder) / "data"
        server = Server(program, data, log, cell=cell, speed=1)
        try:
            job(server, "pick", lambda view: view["step"] == steps.index(STAY) or None, steps)
            time.sleep(0.2)  # until it is stored
        finally:
            server.kill()
        server = Server(program, data, log, cell=cell, speed=1)
        try:
            wait_for("robots", lambda: server.call("GET", API + "/arms/left")[1]["link"] == "up" or None)
            assert server.call("POST", API + "/resume")[0] < 300
            job(server, "away", lambda view: any(text in wait.get("detail", "") for wait in view["waits_on"]) or None,
                [bar_at(0.5)])
            assert server.call("DELETE", API + "/jobs/away")[0] < 300
            job(server, "leave", has_succeeded, [*leaves, *LEAVE])
        finally:
            server.kill()


def main():
    program = sys.argv[1]
    with tempfile.TemporaryDirectory() as folder, open(pathlib.Path(folder) / "log", "w+") as log:
        check_both_hands(program, pathlib.Path(folder) / "data", log)
        print("killed while both hands held the bar", flush=True)
    with tempfile.TemporaryDirectory() as folder, open(pathlib.Path(folder) / "log", "w+") as log:
        check_another_cell(program, folder, log)
        print("started once without the left robot: the part is still held", flush=True)
    for name in LEFT_AT_BAR:
        with tempfile.TemporaryDirectory() as folder, open(pathlib.Path(folder) / "log", "w+") as log:
            check_arm_leaves(program, name, folder, log)
            print(f"killed at the bar, {name}: the arm leaves", flush=True)
    for step in range(len(STEPS)):
        with tempfile.TemporaryDirectory() as folder, open(pathlib.Path(folder) / "log", "w+") as log:
            data = pathlib.Path(folder) / "data"
            at = kill_at(program, step, data, log)
            print(f"killed at step {at}: {check(program, at, data, log)}", flush=True)
    print("killed tasks: OK")


if __name__ == "__main__":
    main()
