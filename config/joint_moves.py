#!/usr/bin/env python3
"""Straight joint moves as Armloom jobs, and the jobs file config/two_pandas_jobs.json.

    python3 config/joint_moves.py SCENARIO > config/two_pandas_jobs.json

SCENARIO is a file with `home`, `poses` and `clear_from_home` (../shared/data/scenarios/
panda_two.json). Each arm goes from home to poses of its `clear_from_home` list and back, all jobs
submitted at time zero: 12 moves out and 12 back, many of them into the middle that both want.

A move is the quintic from rest to rest in all joints at once,
    q(t) = q0 + (q1 - q0) (10 u^3 - 15 u^4 + 6 u^5),  u = t / T,
whose peaks are 15/8 |dq| / T in velocity and 10/sqrt(3) |dq| / T^2 in acceleration. T is the
smallest that keeps both below SHARE of the joints' limits.
"""
import json
import math
import sys

# Franka Emika Panda, rad/s (as in models/panda.urdf); rad/s^2 (as in config/two_pandas.json).
VELOCITY_MAX = [2.175, 2.175, 2.175, 2.175, 2.61, 2.61, 2.61]
ACCELERATION_MAX = [3.75] * 7
SHARE = 0.8
WAYPOINTS = 11

# The scenario's names of the arms of config/two_pandas.json.
ARMS = {"left": "panda1", "right": "panda0"}
# Where each arm goes, in order.
VISITS = {
    "left": ["tiled_up", "twist_right", "tiled_down", "coop_down", "mirror", "twist_left"],
    "right": ["tiled_down", "mirror", "twist_left", "coop_down", "coop_up", "twist_right"],
}


def duration(q0, q1):
    """Seconds that the straight move takes, a multiple of 10 ms."""
    longest = 0.5
    for a, b, velocity, acceleration in zip(q0, q1, VELOCITY_MAX, ACCELERATION_MAX):
        dq = abs(b - a)
        longest = max(longest, 15 / 8 * dq / (SHARE * velocity),
                      math.sqrt(10 / math.sqrt(3) * dq / (SHARE * acceleration)))
    return math.ceil(longest * 100) / 100


def quintic(joint_names, q0, q1, T=None):
    """A trajectory, as the body of POST /jobs wants it."""
    T = T or duration(q0, q1)
    points = []
    for k in range(WAYPOINTS):
        u = k / (WAYPOINTS - 1)
        s = 10 * u**3 - 15 * u**4 + 6 * u**5
        ds = (30 * u**2 - 60 * u**3 + 30 * u**4) / T
        dds = (60 * u - 180 * u**2 + 120 * u**3) / T**2
        ns = round(u * T * 1e9)
        points.append({
            "positions": [round(a + (b - a) * s, 9) for a, b in zip(q0, q1)],
            "velocities": [round((b - a) * ds, 9) for a, b in zip(q0, q1)],
            "accelerations": [round((b - a) * dds, 9) for a, b in zip(q0, q1)],
            "time_from_start": {"sec": ns // 10**9, "nanosec": ns % 10**9},
        })
    return {"joint_names": joint_names, "points": points}


def jobs(scenario):
    listed = []
    for arm, scenario_arm in ARMS.items():
        names = [f"{arm}_panda_joint{i}" for i in range(1, 8)]
        home = scenario["home"]
        for n, pose in enumerate(VISITS[arm], start=1):
            if pose not in scenario["clear_from_home"][scenario_arm]:
                sys.exit(f"{pose} is not in clear_from_home of {scenario_arm}")
            q = scenario["poses"][pose][scenario_arm]
            listed.append((n, 0, arm, f"{arm}-{n}-to-{pose}", f"{pose}", names, home, q))
            listed.append((n, 1, arm, f"{arm}-{n}-home", f"{pose} -> home", names, q, home))
    listed.sort(key=lambda job: (job[0], job[1]))  # the arms take turns
    return [{"at": 0.0, "job": {"id": key, "name": f"{arm}: {name}",
                                "trajectory": quintic(names, q0, q1)}}
            for _, _, arm, key, name, names, q0, q1 in listed]


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    with open(sys.argv[1]) as file:
        scenario = json.load(file)
    lines = ",\n".join(json.dumps(job, separators=(",", ":")) for job in jobs(scenario))
    print(f"[\n{lines}\n]")


if __name__ == "__main__":
    main()
