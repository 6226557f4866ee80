#!/usr/bin/env python3
"""The main job on two Pandas with physics, each in a process of its own.

    test/bench/physics.py ARMLOOM PHYSICS_CONTACTS [--policies earliest_start,coordinated] [--payloads 0,3]
                          [--stops 12] [--tracking-error RAD] [--real-time] [--out FOLDER]

Each run serves config/two_pandas_physics.json in real time, with two `armloom arm --physics` processes, and records
all positions. It submits all jobs of config/two_pandas_jobs.json at once. Then it stops each arm in motion, once per
job, to measure its reaction. Then `armloom audit` and PHYSICS_CONTACTS (MuJoCo) check the recording, and the states in
which both arms were at the same time.
A payload (kg) is in the hand of the left arm, unknown to its drives. The promises are those of the cell file;
--tracking-error replaces the tracking error that the left arm promises.

Prints two tables: results, and what each arm promises beside what was measured. Exit code 1 if a job did not succeed,
bodies touched, or a promise was broken. A run takes about two minutes. With --real-time, server and arms have real-time
priority (chrt, needs root), so that other programs do not delay them.
"""
import argparse
import bisect
import json
import pathlib
import random
import re
import shutil
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
        self.program = (["chrt", "-r", "10"] if options.real_time else []) + [options.armloom]
        self.processes = []
        self.file, self.data = folder / "cell.json", folder / "data"
        text = (TOP / "config/two_pandas_physics.json").read_text()
        text = text.replace('"../models', f'"{TOP}/models').replace("/tmp/armloom-", f"{folder}/")
        if options.tracking_error:
            text = re.sub(r'("tracking_error_rad":) [\d.]+', rf"\1 {options.tracking_error}", text, count=1)
        self.file.write_text(text)
        self.log = open(folder / "log", "w", encoding="utf-8")
        try:
            for arm in ARMS:
                carries = ["--payload", f"left_panda_hand={payload_kg}"] if arm == "left" and payload_kg > 0 else []
                self.start("arm", "--physics", "--robot", arm, "--listen", f"unix:{folder}/{arm}.sock", *carries)
            line = self.start("serve", "--listen", "127.0.0.1:0", "--data", str(self.data), "--record",
                              "--policy", policy)
            self.port = int(re.search(r":(\d+)/", line)[1])
        except BaseException:
            self.end()
            raise

    def start(self, command, *arguments):
        """Returns the first line that the process prints."""
        process = subprocess.Popen([*self.program, command, "--cell", str(self.file), *arguments],
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
        self.of, self.stops, self.offset_ns = {arm: [] for arm in ARMS}, [], {}
        for line in (data / "inputs.jsonl").read_text().splitlines():
            entry = json.loads(line)
            if entry.get("input") == "reported":
                self.of[entry["report"]["arm"]].append((entry["ticks"], entry["report"]))
            elif entry.get("input") == "stop":
                self.stops.append(entry)
        for arm, reports in self.of.items():
            # From the arm's clock to the server's. The fastest report of each second is hardly delayed; a server that
            # is late makes some of them seem too fast.
            delays_ns = [1_000_000 * at - report["time_ns"] for at, report in reports]
            seconds = [min(delays_ns[i:i + 250]) for i in range(0, len(delays_ns), 250)]
            self.offset_ns[arm] = int(statistics.median(seconds))

    def write_true_states(self, data, folder):
        """Writes a recording of where both arms were at each millisecond.

        states.csv has the last report of each arm, and reports are delayed differently.
        """
        folder.mkdir()
        shutil.copy(data / "cell.json", folder)
        (folder / "files").symlink_to(data / "files")
        joints = (data / "states.csv").open(encoding="utf-8").readline().strip().split(",")[1:]
        times = {arm: [report["time_ns"] + self.offset_ns[arm] for _, report in self.of[arm]] for arm in ARMS}
        first = max(of_arm[0] for of_arm in times.values())
        last = min(of_arm[-1] for of_arm in times.values())
        with open(folder / "states.csv", "w", encoding="utf-8") as file:
            print("time_s", *joints, sep=",", file=file)
            for time_ms in range(first // 1_000_000 + 1, last // 1_000_000):
                q = []
                for arm in ARMS:
                    i = bisect.bisect_right(times[arm], 1_000_000 * time_ms)
                    before, after = times[arm][i - 1:i + 1]
                    share = (1_000_000 * time_ms - before) / (after - before)
                    q += [a + share * (b - a) for a, b in zip(self.of[arm][i - 1][1]["positions"],
                                                              self.of[arm][i][1]["positions"])]
                print(f"{time_ms / 1e3:.3f}", *(f"{each:.9f}" for each in q), sep=",", file=file)

    def longest_period_s(self, arm):
        times = [report["time_ns"] for _, report in self.of[arm]]
        return max(b - a for a, b in zip(times, times[1:])) / 1e9

    def reactions_s(self, arm):
        found = [self.reaction_s(arm, stop["ticks"]) for stop in self.stops if arm in stop["arms"]]
        return [reaction for reaction in found if reaction is not None]

    def reaction_s(self, arm, tick):
        """Time from a stop until the first report of slower progress; None if the arm was slower already.

        The delay of the fastest reports counts as reaction, and so does up to one feedback period.
        """
        near = [report for at, report in self.of[arm] if tick - 50 <= at <= tick + 200]
        stop_ns = 1_000_000 * tick - self.offset_ns[arm]  # on the arm's clock
        a, b = [report for report in near if report["time_ns"] <= stop_ns][-2:]
        if b["commanded_ns"] - a["commanded_ns"] < b["time_ns"] - a["time_ns"]:
            return None
        for report in near:
            passed_ns = report["time_ns"] - b["time_ns"]
            if passed_ns > 0 and report["commanded_ns"] - b["commanded_ns"] < passed_ns - NOTICEABLE_NS:
                return (report["time_ns"] - stop_ns) / 1e9
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
    return {arm: {"tracking_rad": float(tracking), "inflation_mm": float(inflation), "reaction_s": float(reaction),
                  "period_s": float(period)}
            for arm, tracking, inflation, reaction, period in re.findall(
                rf"promises of arm (\w+):\n  tracking error {number} .*: inflates the arm by .* at most {number} mm\n"
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
        in_stops = cell.deviations()
    finally:
        cell.end()
    reports, true_states = Reports(cell.data), folder / "true_states"
    reports.write_true_states(cell.data, true_states)
    audits = [last_line(options.armloom, "audit", "--cell", str(cell.file), "--recording", str(recording))
              for recording in (cell.data, true_states)]
    audited = sum(audit["contact"] is not None for audit in audits)
    mujoco = sum(last_line(options.physics_contacts, str(recording))["contacts"]
                 for recording in (cell.data, true_states))
    own = (folder / "log").read_text().count("CONTACT")
    events = [json.loads(line) for line in (cell.data / "events.jsonl").read_text().splitlines()]
    found = [event["data"]["text"] for event in events if event["type"] == "monitor"]
    faults += [f"monitor: {text}" for text in found]
    if audited or mujoco or own:
        faults.append(f"contacts: audit {audits}, MuJoCo {mujoco}, in the processes {own}")
    result = [policy, f"{payload_kg:g} kg", f"{len(done)} of {len(JOBS)}", f"{makespan_s:.1f} s",
              str(audited), str(mujoco), str(own), f"{1e3 * audits[1]['smallest_clearance_m']:.1f} mm", str(len(found))]
    kept = []
    for arm, promised in promises(options.armloom, cell.file).items():
        reactions, period_s = reports.reactions_s(arm), reports.longest_period_s(arm)
        reaction_s = max(reactions, default=float("nan"))
        kept.append([policy, f"{payload_kg:g} kg", arm, f"{1e3 * promised['tracking_rad']:g} mrad",
                     f"{promised['inflation_mm']:g} mm",
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
    parser.add_argument("--stops", type=int, default=12)
    parser.add_argument("--tracking-error", type=float)
    parser.add_argument("--real-time", action="store_true")
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
    print_table(["policy", "payload", "arm", "tracking error promised", "inflates the arm by",
                 "main job", "with stops", "reaction promised", "measured", "feedback promised", "measured"], kept)
    for fault in faults:
        print("does not hold:", fault)
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
