#!/usr/bin/env python3
"""The main job, as a user runs it: simulate the two-Panda jobs, audit what happened.

    test/scenarios/main_job.py ARMLOOM

Checks that every job succeeds under both policies, that the backlog was used, that running beside
each other pays, that the audit finds no contact and finds one in a doctored recording, and that a
seed repeats byte for byte.
"""
import csv
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

TOP = pathlib.Path(__file__).resolve().parents[2]
CELL = TOP / "config/two_pandas.json"
JOBS = TOP / "config/two_pandas_jobs.json"


def run(armloom, *arguments, expect=0):
    done = subprocess.run([armloom, *map(str, arguments)], capture_output=True, text=True,
                          timeout=300)
    if done.returncode != expect:
        sys.exit(f"armloom {' '.join(map(str, arguments))}: exit {done.returncode}, expected "
                 f"{expect}\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
    return json.loads(done.stdout.strip().splitlines()[-1])


def check(claim, holds, figure):
    print(f"{'ok  ' if holds else 'FAIL'} {claim}: {figure}")
    if not holds:
        sys.exit(1)


def events(folder):
    return [json.loads(line) for line in (folder / "events.jsonl").read_text().splitlines()]


def doctor(source, target):
    """A copy of the recording in which, once, the left arm stands where the right one does."""
    shutil.copytree(source, target)
    with open(source / "states.csv") as file:
        header, *rows = list(csv.reader(file))
    row = rows[len(rows) // 2]
    for arm in ("left", "right"):
        # Both stretch out towards each other.
        for joint, q in zip(range(1, 8), (0, 0.6, 0, -1.2, 0, 1.8, 0)):
            row[header.index(f"{arm}_panda_joint{joint}")] = str(q)
    with open(target / "states.csv", "w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([header, *rows])


def main():
    armloom = sys.argv[1]
    total = len(json.loads(JOBS.read_text()))
    check("at least 24 jobs", total >= 24, total)

    with tempfile.TemporaryDirectory() as scratch:
        out = {name: pathlib.Path(scratch) / name for name in ("sequential", "timed", "again")}
        common = ("simulate", "--cell", CELL, "--jobs", JOBS, "--seed", "7")
        sequential = run(armloom, *common, "--policy", "sequential", "--out", out["sequential"])
        timed = run(armloom, *common, "--policy", "timed_discrete", "--out", out["timed"])
        run(armloom, *common, "--policy", "timed_discrete", "--out", out["again"])
        for result in (sequential, timed):
            print(json.dumps(result))
            check(f"all succeed under {result['policy']}", result["jobs"]["succeeded"] == total,
                  result["jobs"])
            check("the monitor stops nothing", result["monitor_stops"] == 0,
                  result["monitor_stops"])
        backlogged = {e["data"]["id"] for e in events(out["timed"])
                      if e["type"] == "job" and e["data"]["state"] == "backlogged"}
        check("at least 5 were backlogged", len(backlogged) >= 5, len(backlogged))
        ratio = timed["makespan_s"] / sequential["makespan_s"]
        check("makespan at most 0.85 of sequential", ratio <= 0.85,
              f"{timed['makespan_s']:.2f} s / {sequential['makespan_s']:.2f} s = {ratio:.3f}")

        for name in ("events.jsonl", "states.csv"):
            check(f"{name} repeats byte for byte",
                  (out["timed"] / name).read_bytes() == (out["again"] / name).read_bytes(),
                  f"{(out['timed'] / name).stat().st_size} B")

        for name in ("sequential", "timed"):
            audit = run(armloom, "audit", "--cell", CELL, "--recording", out[name])
            check("the audit finds no contact", audit["contact"] is None,
                  f"smallest clearance {audit['smallest_clearance_m']:.4f} m")
        doctored = pathlib.Path(scratch) / "doctored"
        doctor(out["timed"], doctored)
        audit = run(armloom, "audit", "--cell", CELL, "--recording", doctored, expect=1)
        check("the audit finds the doctored contact", audit["contact"] is not None,
              audit["contact"])


if __name__ == "__main__":
    main()
