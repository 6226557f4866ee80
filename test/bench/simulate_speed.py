#!/usr/bin/env python3
"""Speed of `armloom simulate` for the two-Panda jobs, relative to real time.

    test/bench/simulate_speed.py ARMLOOM [ROUNDS]

Runs the jobs of config/two_pandas_jobs.json ROUNDS times (default 10) under timed_discrete, with and
without a recording (1 kHz states). Prints cell time over wall time of the whole process, including start-up
and files: the best and the median of five runs.
"""
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

TOP = pathlib.Path(__file__).resolve().parents[2]


def main():
    armloom = sys.argv[1]
    rounds = int(sys.argv[2]) if len(sys.argv) > 2 else 10
    jobs = json.loads((TOP / "config/two_pandas_jobs.json").read_text())
    repeated = [{"at": 30.0 * r, "job": dict(job["job"], id=f"{job['job']['id']}-{r}")}
                for r in range(rounds) for job in jobs]
    with tempfile.TemporaryDirectory() as scratch:
        file = pathlib.Path(scratch) / "jobs.json"
        file.write_text(json.dumps(repeated))
        for name, extra in (("with recording", ["--out", scratch + "/recording"]),
                            ("without", [])):
            ratios = []
            for _ in range(5):
                began = time.perf_counter()
                done = subprocess.run(
                    [armloom, "simulate", "--cell", TOP / "config/two_pandas.json", "--jobs", file,
                     "--policy", "timed_discrete", *extra], capture_output=True, text=True)
                wall_s = time.perf_counter() - began
                if done.returncode != 0:
                    sys.exit(done.stderr)
                result = json.loads(done.stdout.strip().splitlines()[-1])
                ratios.append(result["makespan_s"] / wall_s)
            print(f"{name}: {result['makespan_s']:.0f} s of cell time, "
                  f"{max(ratios):.0f} times real time at best, "
                  f"{statistics.median(ratios):.0f} in the median of 5")


if __name__ == "__main__":
    main()
