#!/usr/bin/env python3
"""Plans, runs and audits every solved query of plan_table as a job.

    test/bench/plan_and_audit.py BUILD [--policy P] CELL [SCENARIO]...

BUILD contains plan_table and armloom. Each arm makes a tour of its poses, from home through every solved
query once and back, with the other arms at home. `armloom simulate` runs these jobs, and `armloom audit`
checks every measured state with plain FCL. Fails if a job does not succeed, or if two bodies come closer than
the cell allows. Prints the table, the number of jobs and the audit's result.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile


def called(*command):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{command[0]}: exit {done.returncode}\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
    return done.stdout


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--policy", default="earliest_start")
    parser.add_argument("cell", type=pathlib.Path)
    parser.add_argument("scenarios", nargs="*", type=pathlib.Path)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        jobs, recording = pathlib.Path(scratch, "jobs.json"), pathlib.Path(scratch, "recording")
        print(called(options.build / "plan_table", options.cell, *options.scenarios, "--jobs", jobs))
        ran = called(options.build / "armloom", "simulate", "--cell", options.cell, "--jobs", jobs,
                     "--policy", options.policy, "--out", recording)
        result = json.loads(ran.strip().splitlines()[-1])
        count = len(json.loads(jobs.read_text()))
        print(f"{count} jobs: {result['jobs']}, {result['makespan_s']:.0f} s, "
              f"{result['monitor_stops']} stops of the monitor")
        audited = called(options.build / "armloom", "audit", "--cell", options.cell,
                         "--recording", recording)
        print(audited.strip())
        if count == 0 or result["jobs"].get("succeeded", 0) != count:
            sys.exit("not all jobs succeeded")


if __name__ == "__main__":
    main()
