#!/usr/bin/env python3
"""The main job on two Pandas with physics, each in a process of its own.

    chrt -r 10 test/bench/physics.py ARMLOOM PHYSICS_CONTACTS [--policies earliest_start,coordinated]
                                     [--payloads 0,3] [--stops 6] [--tracking-error RAD] [--out FOLDER]

Each run serves config/two_pandas_physics.json in real time, with two `armloom arm --physics` processes, and records
all positions. It submits all jobs of config/two_pandas_jobs.json at once. Then it stops each arm in motion, once per
job, to measure its reaction. Then `armloom audit` and PHYSICS_CONTACTS (MuJoCo) check the recording.
A payload (kg) is in the hand of the left arm, unknown to its drives. The promises are those of the cell file;
--tracking-error replaces the tracking error that the left arm promises.

Prints two tables: results, and what each arm promises beside what was measured. Exit code 1 if a job did not succeed,
bodies touched, or a promise was broken. A run takes about a minute. With real-time priority (chrt), other programs do
not delay the arms.
"""
import argparse
import json
import pathlib
import random
import re
import statistics
import subprocess
import sys
import tempfile
import time
import urllib.error
import urllib.request

TOP = pathlib.Path(__file__).resolve().parents[2]
ARMS = ("left", "right")
ENDED = ("succeeded", "failed", "canceled", "interrupted", "expired")
PATIENCE_S = 60.0
NOTICEABLE_NS = 10_000  # of progress
JOBS = [each["job"] for each in json.loads((TOP / "config/two_pandas_jobs.json").read_text())]


class Stuck(Exception):
    pass


class Cell:
    """The server and its two robots."""

    def __init__(self, options, folder, policy, payload_kg):
        self.armloom, self.processes = options.armloom, []
        self.file, self.data = folder / "cell.json", folder / "data"
        text = (TOP / "config/two_pandas_physics.json").read_text()
        text = text.replace('"../models', f'"{TOP}/models').replace("/tmp/armloom-", f"{folder}/")
        if options.tracking_error:
            text = re.sub(r'("tracking_error_rad":) [\d.]+', rf"\1 {options.tracking_error}", text, count=1)
        self.file.write_text(text)
        self.log = open(folder / "log", "w", encoding="utf-8")
        for arm in ARMS:
            carries = ["--payload", f"left_panda_hand={payload_kg}"] if arm == "left" and payload_kg > 0 else []
            self.start("arm", "--physics", "--robot", arm, "--listen", f"unix:{folder}/{arm}.sock", *carries)
        line = self.start("serve", "--listen", "127.0.0.1:0", "--data", str(self.data), "--record", "--policy", policy)
        self.port = int(re.search(r":(\d+)/", line)[1])

    def start(self, command, *arguments):
        """Returns the first line that the process prints."""
        process = subprocess.Popen([self.armloom, command, "--cell", str(self.file), *arguments],
                                   stdout=subprocess.PIPE, stderr=self.log, text=True)
        self.processes.insert(0, process)
        return process.stdout.readline()

    def end(self):
        for process in self.processes:  # the server first
            process.terminate()
            process.wait(20)
        self.log.close()

    def call(self, method, path, body=None):
        request = urllib.request.Request(f"http://127.0.0.1:{self.port}/api/v1{path}", method=method,
                                         data=None if body is None else json.dumps(body).encode(),
                                         headers={"Content-Type": "application/json"})
        try:
            with urllib.request.urlopen(request, timeout=20) as answer:
                return json.loads(answer.read() or b"null")
        except urllib.error.HTTPError as error:
            raise Stuck(f"{method} {path}: {error.read().decode()}") from error

    def arms(self):
        return {arm["name"]: arm for arm in self.call("GET", "/arms")["arms"]}

    def deviations(self):
        return {name: arm["deviation_max_rad"] for name, arm in self.arms().items()}

    def is_any_stopped(self):
        return any(arm["state"] in ("stopped", "fault") for arm in self.arms().values())

    @staticmethod
    def wait_for(holds, what, pause_s=0.01):
        end = time.monotonic() + PATIENCE_S
        while not holds():
            if time.monotonic() > end:
                raise Stuck(f"waited {PATIENCE_S:.0f} s for {what}")
            time.sleep(pause_s)

    def main_job(self):
        """Returns the jobs when they have ended, or when an arm was stopped."""
        self.wait_for(lambda: all(arm["link"] == "up" and arm["state"] == "idle" for arm in self.arms().values()),
                      "both arms")
        self.call("POST", "/batches", {"jobs": JOBS, "atomic": True})
        jobs = lambda: self.call("GET", "/jobs?limit=100")["jobs"]  # noqa: E731
        self.wait_for(lambda: all(job["state"] in ENDED for job in jobs()) or self.is_any_stopped(), "the jobs", 0.1)
        return jobs()

    def stop_in_motion(self, arm, count, rng):
        """Repeats the arm's first jobs while the other arm is at home. Stops and resumes each one on its way."""
        for job in [job for job in JOBS if job["id"].startswith(arm)][:count]:
            path = f"/jobs/stopped-{job['id']}"
            share = rng.uniform(0.3, 0.6)
            self.call("POST", "/jobs", {**job, "id": f"stopped-{job['id']}"})
            self.wait_for(lambda: self.call("GET", path)["progress"] > share or self.is_any_stopped(), "motion", 0.002)
            self.call("POST", f"/arms/{arm}/stop")
            time.sleep(0.6)  # until it rests
            self.call("POST", f"/arms/{arm}/resume")
            self.wait_for(lambda: self.call("GET", path)["state"] in ENDED or self.is_any_stopped(), "its end")
            if (ended := self.call("GET", path))["state"] != "succeeded":
                raise Stuck(f"{ended['id']}: {ended['state']}, {ended['waits_on'] or ended['result']}")


# ---- The recording ----

class Reports:
    """Reports of the arms, and stops, each with the control cycle (1 ms) in which it arrived."""

    def __init__(self, data):
        self.of, self.stops = {arm: [] for arm in ARMS}, []
        for line in (data / "inputs.jsonl").read_text().splitlines():
            entry = json.loads(line)
            if entry.get("input") == "reported":
                self.of[entry["report"]["arm"]].append((entry["ticks"], entry["report"]))
            elif entry.get("input") == "stop":
                self.stops.append(entry)

    def longest_period_s(self, arm):
        times = [report["time_ns"] for _, report in self.of[arm]]
        return max(b - a for a, b in zip(times, times[1:])) / 1e9

    def reactions_s(self, arm):
        found = [self.reaction_s(arm, stop["ticks"]) for stop in self.stops if arm in stop["arms"]]
        return [reaction for reaction in found if reaction is not None]

    def reaction_s(self, arm, tick):
        """Time from a stop until the first report of slower progress; None if the arm was slower already.

        The clocks of server and arm are compared by the fastest report of half a second, whose delay therefore counts
        as reaction. So does up to one feedback period.
        """
        near = [(at, report) for at, report in self.of[arm] if tick - 500 <= at <= tick + 200]
        offset_ns = min(1_000_000 * at - report["time_ns"] for at, report in near if at <= tick)
        (_, a), (_, b) = [each for each in near if each[0] <= tick][-2:]
        if b["commanded_ns"] - a["commanded_ns"] < b["time_ns"] - a["time_ns"]:
            return None
        for _, report in near:
            passed_ns = report["time_ns"] - b["time_ns"]
            if passed_ns > 0 and report["commanded_ns"] - b["commanded_ns"] < passed_ns - NOTICEABLE_NS:
                return (report["time_ns"] + offset_ns) / 1e9 - tick / 1e3
        return None


def last_line(*command):
    ended = subprocess.run(command, capture_output=True, text=True, check=False)
    if ended.returncode not in (0, 1):
        sys.exit(f"{' '.join(command)}: {ended.stderr}")
    return json.loads(ended.stdout.strip().splitlines()[-1])


def promises(armloom, file):
    """Returns what `armloom validate` says of each arm's promises."""
    text = subprocess.run([armloom, "validate", "--cell", str(file)], capture_output=True, text=True, check=True).stdout
    number = r"([\d.e-]+)"
    return {arm: {"tracking_rad": float(tracking), "inflation": inflation, "reaction_s": float(reaction),
                  "period_s": float(period)}
            for arm, tracking, inflation, reaction, period in re.findall(
                rf"promises of arm (\w+):\n  tracking error {number} .*: inflates the arm by (.*)\n"
                rf"  reaction {number} s:.*\n  feedback every {number} s", text)}


# ---- A run ----

def measure(options, folder, policy, payload_kg):
    """Makes one run. Returns its row of results, its rows of promises, and its faults."""
    cell, faults = Cell(options, folder, policy, payload_kg), []
    in_jobs = in_stops = dict.fromkeys(ARMS, float("nan"))
    done, makespan_s = [], float("nan")
    try:
        jobs = cell.main_job()
        in_jobs = cell.deviations()
        done = [job for job in jobs if job["state"] == "succeeded"]
        if len(done) < len(jobs):
            faults.append(f"{len(done)} of {len(jobs)} jobs succeeded")
        else:
            makespan_s = max(job["ended_s"] for job in jobs) - min(job["submitted_s"] for job in jobs)
            rng = random.Random(1)
            for arm in ARMS:
                cell.stop_in_motion(arm, options.stops, rng)
        in_stops = cell.deviations()
    except Stuck as fault:
        faults.append(str(fault))
    finally:
        cell.end()
    audit = last_line(options.armloom, "audit", "--cell", str(cell.file), "--recording", str(cell.data))
    mujoco = last_line(options.physics_contacts, str(cell.data))["contacts"]
    own = (folder / "log").read_text().count("CONTACT")
    events = [json.loads(line) for line in (cell.data / "events.jsonl").read_text().splitlines()]
    found = [event["data"]["text"] for event in events if event["type"] == "monitor"]
    faults += [f"monitor: {text}" for text in found]
    if audit["contact"] or mujoco or own:
        faults.append(f"contacts: audit {audit['contact']}, MuJoCo {mujoco}, in the processes {own}")
    result = [policy, f"{payload_kg:g} kg", f"{len(done)} of {len(JOBS)}", f"{makespan_s:.1f} s",
              str(int(audit["contact"] is not None)), str(mujoco), str(own),
              f"{1e3 * audit['smallest_clearance_m']:.1f} mm", str(len(found))]
    reports, kept = Reports(cell.data), []
    for arm, promised in promises(options.armloom, cell.file).items():
        reactions, period_s = reports.reactions_s(arm), reports.longest_period_s(arm)
        reaction_s = max(reactions, default=float("nan"))
        kept.append([policy, f"{payload_kg:g} kg", arm, f"{1e3 * promised['tracking_rad']:g} mrad",
                     f"{1e3 * in_jobs[arm]:.3f}", f"{1e3 * in_stops[arm]:.3f}", f"{1e3 * promised['reaction_s']:g} ms",
                     f"{1e3 * reaction_s:.1f} ({len(reactions)})", f"{1e3 * promised['period_s']:g} ms",
                     f"{1e3 * period_s:.1f}"])
        for what, measured, limit in (("tracking error", in_stops[arm], promised["tracking_rad"]),
                                      ("reaction", reaction_s, promised["reaction_s"]),
                                      ("feedback period", period_s, promised["period_s"] + 1e-6)):
            if not measured <= limit:
                faults.append(f"{arm}: {what} {measured:.5f}, promised {limit:.5f}")
    return result, kept, faults


def print_table(head, rows):
    for row in (head, ["---"] * len(head), *rows):
        print("| " + " | ".join(row) + " |")
    print()


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("armloom")
    parser.add_argument("physics_contacts")
    parser.add_argument("--policies", default="earliest_start,coordinated")
    parser.add_argument("--payloads", default="0,3")
    parser.add_argument("--stops", type=int, default=6)
    parser.add_argument("--tracking-error", type=float)
    parser.add_argument("--out", type=pathlib.Path)
    options = parser.parse_args()
    results, kept, faults = [], [], []
    with tempfile.TemporaryDirectory(prefix="armloom-physics-") as temporary:
        for payload_kg in map(float, options.payloads.split(",")):
            for policy in options.policies.split(","):
                folder = (options.out or pathlib.Path(temporary)) / f"{policy}-{payload_kg:g}"
                folder.mkdir(parents=True)
                result, of_arms, wrong = measure(options, folder, policy, payload_kg)
                results.append(result)
                kept += of_arms
                faults += [f"{policy}, {payload_kg:g} kg: {each}" for each in wrong]
    print_table(["policy", "payload", "jobs", "makespan", "contacts: audit", "MuJoCo, both arms", "MuJoCo, each arm",
                 "clearance", "stops by monitor"], results)
    print_table(["policy", "payload", "arm", "tracking error promised", "main job", "with stops", "reaction promised",
                 "measured", "feedback promised", "measured"], kept)
    for fault in faults:
        print("does not hold:", fault)
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
