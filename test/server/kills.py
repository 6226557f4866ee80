#!/usr/bin/env python3
"""Kills the server (kill -9) while jobs are submitted, wait, run and end, and checks the state that the next server restores.

    test/server/kills.py ARMLOOM [--kills 12] [--seed 1] [--folder DIR] [--power-cuts LIBRARY] [--only KIND ...]

Kinds of kills, in turn; N grows from 1:
- at a random time,
- at the Nth published change of a job's state,
- at the Nth sync or write of the database (needs strace),
- after some writes or syncs that fail, as on a full or broken disk (needs strace),
- a power cut instead of the Nth sync: unsynced data is lost or survives in part (needs the library synced_copy of
  the build).

After each kill
- every acknowledged job is there, once, in the order of acceptance,
- ended jobs have kept their end, and waiting jobs still wait,
- jobs that had moved are `interrupted` and stay so,
- arms are stopped until they are resumed.

No job moves in two sessions (read from the recordings). The long run is --kills 1000.
"""
import argparse
import http.client
import json
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import threading
import time

from killed_server import API, Kill, NotUp, Server, swing
from power_cut import SyncedCopy

ENDED = {"succeeded", "canceled", "expired", "failed", "interrupted"}
ONE_LIFE = 50  # number of kills before a new data folder


class Trial:
    """The known states of the jobs of all sessions."""

    def __init__(self, rng):
        self.rng = rng
        self.order = []  # ids in the order of acknowledgement on one connection
        self.ended = {}  # id: terminal state seen
        self.next = 0

    def one(self, server):
        self.next += 1
        arm = self.rng.choice(["left", "right"])
        recent = [job for job in self.order[-6:] if job not in self.ended]
        after = [self.rng.choice(recent)] if recent and self.rng.random() < 0.2 else []
        return swing(f"k{self.next}", arm, self.rng.choice([0.8, 1.5]), after)

    def load(self, server, done):
        """Resumes, submits, cancels and lists jobs until the server is gone."""
        try:
            server.call("POST", API + "/resume")
            while not done.is_set():
                what = self.rng.random()
                if what < 0.1:
                    jobs = [self.one(server) for _ in range(3)]
                    status, _ = server.call("POST", API + "/batches", {"jobs": jobs})
                    if status == 202:
                        self.order += [job["id"] for job in jobs]
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
        except (OSError, ValueError, http.client.HTTPException):
            pass  # killed

    def look(self, server):
        """Compares the new server's jobs with the known states; returns the number of waiting jobs."""
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
        _, told = server.call("GET", API + "/alerts")
        damage = [alert["text"] for alert in told["alerts"] if "data folder" in alert["text"]]
        assert not damage, f"reported damage, but the folder is sound: {damage}"
        if open_jobs:
            _, queue = server.call("GET", API + "/queue")
            assert queue["stopped"], "arms may move before a resume"
        return len(open_jobs)


def moved_in(folder):
    """Returns the jobs that started in this session."""
    moved = set()
    with open(folder / "events.jsonl", encoding="utf-8") as events:
        for line in events:
            if not line.endswith("\n"):
                break  # cut off by the kill
            event = json.loads(line)
            if event["type"] == "job" and event["data"]["started_at"] is not None:
                moved.add(event["data"]["id"])
    return moved


class Lives:
    """One data folder after the other, each with many sessions."""

    def __init__(self, program, folder, seed, kinds, library):
        self.program, self.folder, self.rng, self.kinds = program, folder, random.Random(seed), kinds
        self.synced = SyncedCopy(library, folder / "data")
        self.log = open(folder / "log", "a", encoding="utf-8")
        self.up, self.kills, self.came = [], 0, dict.fromkeys(self.kinds, 0)
        self.acknowledged = self.waited = self.interrupted = self.moved_jobs = 0

    def next_kill(self):
        kind = self.kinds[self.kills % len(self.kinds)]
        nth = 1 + self.kills // len(self.kinds)
        self.kills += 1
        return Kill(kind, 1 + nth % {"time": 1, "change": 40, "fdatasync": 60, Kill.POWER_CUT: 60}.get(kind, 150))

    def saw_enough(self):
        return self.acknowledged >= self.kills and self.moved_jobs and self.interrupted and self.waited

    def live(self, kills):
        trial, data, moved = Trial(self.rng), self.folder / "data", {}
        for number in range(kills):
            kill = self.next_kill()
            try:
                self.run_once(trial, data, moved, kill)
            except NotUp:
                if not kill.may_hinder_start():
                    raise
                self.came[kill.kind] += 1
            except AssertionError as found:
                raise AssertionError(f"kill {number} of this folder, the one at {kill}: {found}") from found
            if kill.cuts_power():
                self.synced.cut(self.rng)
        server = Server(self.program, data, self.log)  # checks the state after the last kill
        try:
            self.look_through(trial, server)
        finally:
            server.kill()
        self.acknowledged += len(trial.order)
        self.interrupted += sum(state == "interrupted" for state in trial.ended.values())
        self.moved_jobs += len(moved)
        shutil.rmtree(data)

    def look_through(self, trial, server):
        self.waited += trial.look(server)
        self.up.append(time.monotonic() - server.began)

    def run_once(self, trial, data, moved, kill):
        before = recordings(data)
        environment = self.synced.environment(kill.nth) if kill.cuts_power() else None
        server = Server(self.program, data, self.log, kill.tracer(), environment)
        done = threading.Event()
        try:
            # A server that is killed while it starts, or whose disk fails, is checked by the next session.
            if not kill.may_hinder_start():
                self.look_through(trial, server)
            load = threading.Thread(target=trial.load, args=(server, done))
            load.start()
            self.came[kill.kind] += kill.await_and_kill(server, self.rng)
        finally:
            server.kill()
            done.set()
        load.join()
        for events in recordings(data) - before:
            for job in moved_in(events.parent):
                assert job not in moved, f"{job} has moved in two runs: {moved[job]}, {kill}"
                moved[job] = str(kill)
            if events.parent != data:
                shutil.rmtree(events.parent)


def recordings(data):
    return set(data.glob("*/events.jsonl")) | set(data.glob("events.jsonl"))


def possible_kinds(library):
    can_trace = shutil.which("strace") and subprocess.run(["strace", "-o", "/dev/null", "true"]).returncode == 0
    return Kill.KINDS + (Kill.TRACED if can_trace else []) + ([Kill.POWER_CUT] if library else [])


def run(program, kills, seed, folder, kinds, library):
    lives = Lives(program, folder, seed, kinds, library)
    # On a busy machine few jobs are acknowledged before a kill.
    while lives.kills < kills or (not lives.saw_enough() and lives.kills < 5 * kills):
        lives.live(min(ONE_LIFE, max(kills - lives.kills, 6)))
    print(f"{lives.kills} kills, seed {seed}: {lives.acknowledged} jobs acknowledged, {lives.moved_jobs} moved, "
          f"{lives.interrupted} interrupted, {lives.waited} found waiting; up and looked through after "
          f"{sorted(lives.up)[len(lives.up) // 2]:.2f} s, {max(lives.up):.2f} s at most\ncame where they were to: "
          + ", ".join(f"{kind} {count}" for kind, count in lives.came.items()))
    assert lives.saw_enough(), "too little"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--kills", type=int, default=12)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--folder")
    parser.add_argument("--power-cuts", metavar="LIBRARY", type=pathlib.Path)
    parser.add_argument("--only", nargs="*", metavar="KIND")
    options = parser.parse_args()
    library = options.power_cuts and options.power_cuts.resolve()
    kinds = [kind for kind in possible_kinds(library) if kind in (options.only or [kind])]
    if not kinds:
        parser.error(f"none of these is possible here: {options.only}")
    folder = pathlib.Path(options.folder or tempfile.mkdtemp(prefix="armloom-kills-"))
    folder.mkdir(parents=True, exist_ok=True)
    try:
        run(options.program, options.kills, options.seed, folder, kinds, library)
    except NotUp as error:
        sys.exit(str(error))
    if not options.folder:
        shutil.rmtree(folder)


if __name__ == "__main__":
    main()
