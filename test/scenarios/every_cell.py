#!/usr/bin/env python3
"""Runs every cell like a user: validate, simulate its jobs, audit.

    test/scenarios/every_cell.py ARMLOOM

For each cell under timed_discrete (the cell with meshes under every policy):
- validate finds no fault,
- all jobs (at least 12) succeed, some after waiting for another arm (timed_discrete only),
- the monitor stops nothing,
- the audit finds no contact.
"""
import json
import pathlib
import subprocess
import sys
import tempfile

CONFIG = pathlib.Path(__file__).resolve().parents[2] / "config"
CELLS = ("two_pandas", "four_pandas", "panda_and_ur5e", "dual_panda", "two_shuttles")
POLICIES = ("sequential", "lockstep", "reservation", "certified", "earliest_start", "coordinated")
EVERY_POLICY = "two_shuttles"


def run(armloom, *arguments):
    done = subprocess.run([armloom, *map(str, arguments)], capture_output=True, text=True,
                          timeout=300)
    if done.returncode != 0:
        sys.exit(f"armloom {' '.join(map(str, arguments))}: exit {done.returncode}\n"
                 f"{done.stdout[-2000:]}{done.stderr[-2000:]}")
    return done.stdout.strip().splitlines()[-1]


def check(claim, holds, figure):
    print(f"{'ok  ' if holds else 'FAIL'} {claim}: {figure}")
    if not holds:
        sys.exit(1)


def waited_for_another_arm(folder):
    """Returns ids of jobs that were backlogged because of another arm's job or rest."""
    waited = set()
    for line in (folder / "events.jsonl").read_text().splitlines():
        event = json.loads(line)
        if event["type"] == "job" and event["data"]["state"] == "backlogged":
            if any(w["kind"] in ("job", "arm") and w["arm"] not in event["data"]["arms"]
                   for w in event["data"]["waits_on"]):
                waited.add(event["data"]["id"])
    return sorted(waited)


def run_cell(armloom, name, scratch):
    cell, jobs = CONFIG / f"{name}.json", CONFIG / f"{name}_jobs.json"
    total = len(json.loads(jobs.read_text()))
    check(f"{name} has at least 12 jobs", total >= 12, total)
    verdict = run(armloom, "validate", "--cell", cell)
    check(f"validate finds no fault in {name}", verdict == "no fault found", verdict)

    recording, busy = run_jobs(armloom, cell, jobs, "timed_discrete", scratch)
    waited = waited_for_another_arm(recording)
    check("some waited for another arm", len(waited) >= 2, waited)
    check("the arms run concurrently", sum(busy.values()) > 1, busy)
    for policy in POLICIES if name == EVERY_POLICY else ():
        run_jobs(armloom, cell, jobs, policy, scratch)


def run_jobs(armloom, cell, jobs, policy, scratch):
    """Simulates and audits; returns the recording's folder and the busy ratio of each arm."""
    recording = pathlib.Path(scratch) / f"{cell.stem}_{policy}"
    result = json.loads(run(armloom, "simulate", "--cell", cell, "--jobs", jobs, "--seed", "7",
                            "--policy", policy, "--out", recording))
    print(json.dumps(result))
    total = len(json.loads(jobs.read_text()))
    check(f"all succeed under {policy}", result["jobs"]["succeeded"] == total, result["jobs"])
    check("the monitor stops nothing", result["monitor_stops"] == 0, result["monitor_stops"])
    audit = json.loads(run(armloom, "audit", "--cell", cell, "--recording", recording))
    check("the audit finds no contact", audit["contact"] is None and audit["states"] > 1000,
          f"smallest clearance {audit['smallest_clearance_m']:.4f} m")
    return recording, result["arm_busy_ratio"]


def main():
    with tempfile.TemporaryDirectory() as scratch:
        for name in CELLS:
            run_cell(sys.argv[1], name, scratch)


if __name__ == "__main__":
    main()
