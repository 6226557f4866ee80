#!/usr/bin/env python3
"""Kills the server (kill -9) while jobs come in, wait, run and end, and looks at what the next one finds.

    test/server/kills.py ARMLOOM [--kills 12] [--seed 1] [--folder DIR]

After each kill: every job that was acknowledged is there, once, in the order in which it was accepted;
what had ended has ended as it had; what waited waits; what had moved is `interrupted` and stays so;
arms are stopped until they are resumed. Over all runs no job has moved in two of them (the recordings
say so). With --kills 1000 it is the long run.
"""
import argparse
import json
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import threading
import time
import urllib.error
import urllib.request

ROOT = pathlib.Path(__file__).resolve().parents[2]
ENDED = {"succeeded", "canceled", "expired", "failed", "interrupted"}
HOME = [0, -1.2, 0, -2.6, 0, 1.6, 0.785]
API = "/api/v1"


def swing(job_id, arm, duration_s, after):
    """There and back, so that it can begin wherever another one has ended."""
    away = [HOME[0] + (0.3 if arm == "left" else -0.3)] + HOME[1:]
    still = [0.0] * 7
    points = [{"positions": q, "velocities": still, "time_from_start": duration_s * i / 2}
              for i, q in enumerate((HOME, away, HOME))]
    return {"id": job_id, "after": after, "trajectory": {
        "joint_names": [f"{arm}_panda_joint{j}" for j in range(1, 8)], "points": points}}


class Server:
    def __init__(self, program, data, log):
        self.process = subprocess.Popen(
            [program, "serve", "--cell", str(ROOT / "config/two_pandas.json"), "--speed", "5",
             "--listen", "127.0.0.1:0", "--data", str(data)],
            stdout=subprocess.PIPE, stderr=log, text=True)
        line = self.process.stdout.readline()
        if ":" not in line:
            sys.exit(f"the server did not come up: {line!r}, see {log.name}")
        self.port = int(line.rsplit(":", 1)[1].strip("/\n"))

    def call(self, method, path, body=None):
        request = urllib.request.Request(
            f"http://127.0.0.1:{self.port}{path}", method=method,
            data=None if body is None else json.dumps(body).encode(),
            headers={"Content-Type": "application/json"})
        try:
            with urllib.request.urlopen(request, timeout=20) as answer:
                return answer.status, json.loads(answer.read() or b"null")
        except urllib.error.HTTPError as error:
            return error.code, json.loads(error.read() or b"null")

    def kill(self):
        self.process.kill()
        self.process.wait()


class Trial:
    """What is known of the jobs of all runs."""

    def __init__(self, rng):
        self.rng = rng
        self.order = []     # ids, as acknowledged one after the other on one connection
        self.ended = {}     # id: the state in which it was seen to end
        self.next = 0
        self.batches = 0

    def one(self, server):
        self.next += 1
        arm = self.rng.choice(["left", "right"])
        recent = [job for job in self.order[-6:] if job not in self.ended]
        after = [self.rng.choice(recent)] if recent and self.rng.random() < 0.2 else []
        return swing(f"k{self.next}", arm, self.rng.choice([0.8, 1.5]), after)

    def load(self, server, done):
        """Submits, cancels and looks until the server is gone."""
        try:
            while not done.is_set():
                what = self.rng.random()
                if what < 0.1:
                    jobs = [self.one(server) for _ in range(3)]
                    status, _ = server.call("POST", API + "/batches", {"jobs": jobs})
                    if status == 202:
                        self.order += [job["id"] for job in jobs]
                        self.batches += 1
                elif what < 0.8:
                    job = self.one(server)
                    status, _ = server.call("POST", API + "/jobs", job)
                    if status == 202:
                        self.order.append(job["id"])
                elif what < 0.85 and self.order:
                    job_id = self.rng.choice(self.order)
                    status, job = server.call("DELETE", API + "/jobs/" + job_id)
                    if status == 202 and job["state"] == "canceled":
                        self.ended[job_id] = "canceled"
                else:
                    server.call("GET", API + "/jobs?limit=200")
        except (OSError, ValueError):
            pass  # killed

    def look(self, server):
        """What the new server says of all that is known; returns how many wait."""
        jobs, cursor = [], ""
        while True:
            _, page = server.call("GET", API + "/jobs?limit=1000" + cursor)
            jobs += page["jobs"]
            if page["next_cursor"] is None:
                break
            cursor = "&cursor=" + page["next_cursor"]
        jobs.reverse()
        by_id = {}
        for job in jobs:
            assert job["id"] not in by_id, f"{job['id']} is there twice"
            by_id[job["id"]] = job
        lost = [job for job in self.order if job not in by_id]
        assert not lost, f"acknowledged, and lost: {lost}"
        known = set(self.order)
        listed = [job["id"] for job in jobs if job["id"] in known]
        assert listed == self.order, "the order has changed"
        for job_id, state in self.ended.items():
            assert by_id[job_id]["state"] == state, f"{job_id} was {state}: {by_id[job_id]}"
        open_jobs = [job for job in jobs if job["state"] not in ENDED]
        for job in open_jobs:
            assert job["state"] in ("queued", "backlogged"), job
            assert job["started_at"] is None, f"it has moved: {job}"
        for job in jobs:
            if job["state"] in ENDED and job["id"] in known:
                self.ended[job["id"]] = job["state"]
        if open_jobs:
            _, queue = server.call("GET", API + "/queue")
            assert queue["stopped"], "arms may move before anyone has said so"
        return len(open_jobs)


def moved_in(folder):
    """The jobs that were told to be running in this run."""
    moved = set()
    with open(folder / "events.jsonl", encoding="utf-8") as events:
        for line in events:
            if not line.endswith("\n"):
                break  # the kill came in the middle of it
            event = json.loads(line)
            if event["type"] == "job" and event["data"]["started_at"] is not None:
                moved.add(event["data"]["id"])
    return moved


def run(program, kills, seed, folder):
    rng = random.Random(seed)
    trial, data, moved = Trial(rng), folder / "data", {}
    up, waited = [], 0
    log = open(folder / "log", "a", encoding="utf-8")
    for number in range(kills + 1):
        before = set(data.glob("*/events.jsonl")) | set(data.glob("events.jsonl"))
        began = time.monotonic()
        server = Server(program, data, log)
        waiting = trial.look(server)
        up.append(time.monotonic() - began)
        waited += waiting
        server.call("POST", API + "/resume")
        done = threading.Event()
        load = threading.Thread(target=trial.load, args=(server, done))
        load.start()
        time.sleep(rng.uniform(0.0, 0.6))
        server.kill()
        done.set()
        load.join()
        after = set(data.glob("*/events.jsonl")) | set(data.glob("events.jsonl"))
        for events in after - before:
            for job in moved_in(events.parent):
                assert job not in moved, f"{job} has moved in two runs: {moved[job]}, {number}"
                moved[job] = number
            if events.parent != data:
                shutil.rmtree(events.parent)
    interrupted = sum(state == "interrupted" for state in trial.ended.values())
    print(f"{kills} kills, seed {seed}: {len(trial.order)} jobs acknowledged ({trial.batches} batches), "
          f"{len(moved)} moved, {interrupted} interrupted, {waited} found waiting; "
          f"up and looked through after {sorted(up)[len(up) // 2]:.2f} s, {max(up):.2f} s at most")
    assert len(trial.order) >= 2 * kills and moved and interrupted and waited, "too little was tried"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--kills", type=int, default=12)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--folder")
    options = parser.parse_args()
    folder = pathlib.Path(options.folder or tempfile.mkdtemp(prefix="armloom-kills-"))
    folder.mkdir(parents=True, exist_ok=True)
    run(options.program, options.kills, options.seed, folder)
    if not options.folder:
        shutil.rmtree(folder)


if __name__ == "__main__":
    main()
