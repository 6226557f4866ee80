#!/usr/bin/env python3
"""Straight joint moves as Armloom jobs, and the jobs files of the cells in config/.

    python3 config/joint_moves.py CELL > config/CELL_jobs.json

CELL is a name from CELLS below. Its arms move from home to each of their poses and back. All jobs
are submitted at time zero; many of them compete for the middle.

A move is the quintic from rest to rest in all joints at once,
    q(t) = q0 + (q1 - q0) (10 u^3 - 15 u^4 + 6 u^5),  u = t / T,
whose peaks are 15/8 |dq| / T in velocity and 10/sqrt(3) |dq| / T^2 in acceleration. T is the
smallest that keeps both below SHARE of the joints' limits.
"""
import json
import math
import sys
from typing import NamedTuple

SHARE = 0.8
WAYPOINTS = 11


class Robot(NamedTuple):
    joints: list
    velocity_max: list  # rad/s, as in models/
    acceleration_max: list  # rad/s^2, as in config/
    home: list


class Arm(NamedTuple):
    name: str
    robot: Robot
    prefix: str  # of joint names
    poses: dict  # name -> configuration


PANDA = Robot([f"panda_joint{i}" for i in range(1, 8)],
              [2.175, 2.175, 2.175, 2.175, 2.61, 2.61, 2.61], [3.75] * 7,
              [0, -1.2, 0, -2.6, 0, 1.6, 0.785])
UR5E = Robot(["shoulder_pan_joint", "shoulder_lift_joint", "elbow_joint", "wrist_1_joint",
              "wrist_2_joint", "wrist_3_joint"], [math.pi] * 6, [4] * 6,
             [0, -2.3, 2.6, -1.87, -1.5708, 0])
# The tool points straight down if joints 2, 3 and 5 add up to pi / 2.
SHUTTLE = Robot([f"joint_{i}" for i in range(1, 7)], [3.2, 3.0, 3.2, 5.2, 5.2, 7.0], [3.75] * 6,
                [0, -0.5, 0.5, 0, 1.57, 0])

CELLS = {
    # Poses and bases are published with the planning environments of mr_planner (panda_two,
    # panda_four). Only poses are used whose straight move from home keeps clear of the other arms
    # at home. mr_planner's panda1 is left, its panda0 is right.
    "two_pandas": [
        Arm("left", PANDA, "left_", {
            "tiled_up": [0.0, -0.25, 0.0, -1.6, 0.0, 2.7, 0.0],
            "twist_right": [0.2949, 0.3483, 0.7806, -1.6474, 0.0, 2.094, 0.0],
            "tiled_down": [0.0, -0.3, 0.0, -2.0, 0.0, 0.8, 0.0],
            "coop_down": [0.0, -0.5, 0.0, -2.9, 0.0, 2.4, 0.0],
            "mirror": [-0.25, 0.0, -0.312, -2.0262, 1.2481, 0.7075, 0.0],
            "twist_left": [-1.4202, 1.0485, 0.284, -1.5, 2.2535, 1.0, 0.0],
        }),
        Arm("right", PANDA, "right_", {
            "tiled_down": [0.0, 0.0, 0.0, -2.6, 0.0, 2.5, 0.0],
            "mirror": [-0.25, 0.0, -0.312, -2.0231, 1.2481, 0.7015, 0.0],
            "twist_left": [0.2949, 0.3483, 0.7807, -1.6474, 0.0, 2.082, 0.0],
            "coop_down": [0.0, -0.5, 0.0, -2.9, 0.0, 2.4, 0.0],
            "coop_up": [0.0, -0.7, 0.0, -1.8, 0.0, 2.6, 0.0],
            "twist_right": [-1.4201, 1.0485, 0.2839, -1.5, 2.2535, 1.0, 0.0],
        }),
    ],
    "four_pandas": [
        Arm("panda0", PANDA, "panda0_", {
            "down": [0.0, -0.5, 0.0, -3.0, 0.0, 2.5, 0.0],
            "left_and_right": [1.0, -1.0, 0.0, -2.3, 0.0, 2.3, 0.0],
            "tiled_clean": [0.0, 0.4, 0.0, -1.0, 0.0, 1.5, 0.0],
            "up_and_down": [0.0, -1.0, 0.0, -2.3, 0.0, 2.3, 0.0],
        }),
        Arm("panda1", PANDA, "panda1_", {
            "up_and_down": [0.0, 0.0, -0.4, -2.7, 1.8, 1.2, 0.0],
            "front": [1.0, -1.0, 0.0, -1.7, 0.0, 1.8, 0.0],
            "down": [0.0, -0.5, 0.0, -3.0, 0.0, 2.5, 0.0],
            "left_and_right": [-1.0, 0.0, -0.4, -2.7, 1.8, 1.2, 0.0],
        }),
        Arm("panda2", PANDA, "panda2_", {
            "up_and_down": [0.0, -1.0, 0.0, -2.3, 0.0, 2.3, 0.0],
            "left_and_right": [1.0, -1.0, 0.0, -2.3, 0.0, 2.3, 0.0],
            "tiled_mess": [0.2, 0.2, -0.3, -1.3, -0.45, 2.6, 0.0],
            "front": [-1.0, -0.5, 0.0, -1.5, 0.0, 1.8, 0.0],
        }),
        Arm("panda3", PANDA, "panda3_", {
            "ready": [0.0, -0.5, 0.0, -1.5, 0.0, 1.0, 0.0],
            "back": [0.5, -0.5, 0.0, -1.5, 0.0, 1.8, 0.0],
            "up": [0.0, -0.1, 0.0, -0.6, 0.0, 1.8, 0.0],
            "front_and_back": [1.0, -0.6, 0.0, -2.5, 0.0, 2.3, 0.0],
        }),
    ],
    # Tools point down at the table; both arms reach beyond the middle between them.
    "panda_and_ur5e": [
        Arm("panda", PANDA, "panda_", {
            "middle": [0, -0.1, 0, -2.0, 0, 1.9, 0.785],
            "left": [0.4, 0.1, 0, -1.8, 0, 1.9, 0.785],
            "right": [-0.4, 0.1, 0, -1.8, 0, 1.9, 0.785],
            "far": [0, 0.3, 0, -1.6, 0, 1.9, 0.785],
        }),
        Arm("ur5e", UR5E, "ur5e_", {
            "middle": [0, -1.5, 1.9, -1.97, -1.5708, 0],
            "right": [-0.4, -1.3, 1.65, -1.92, -1.5708, 0],
            "left": [0.4, -1.3, 1.65, -1.92, -1.5708, 0],
            "far": [0, -1.2, 1.5, -1.87, -1.5708, 0],
        }),
    ],
    # Side by side: each arm reaches ahead, between both, and in front of the other arm.
    "dual_panda": [
        Arm("left", PANDA, "left_", {
            "between": [-0.5, 0.1, 0, -1.9, 0, 2.0, 0.785],
            "ahead": [0, 0.2, 0, -1.8, 0, 2.0, 0.785],
            "across": [-0.9, 0.4, 0, -1.5, 0, 1.9, 0.785],
            "outside": [0.7, 0, 0, -2.0, 0, 2.0, 0.785],
        }),
        Arm("right", PANDA, "right_", {
            "between": [0.5, 0.1, 0, -1.9, 0, 2.0, 0.785],
            "across": [0.9, 0.4, 0, -1.5, 0, 1.9, 0.785],
            "ahead": [0, 0.2, 0, -1.8, 0, 2.0, 0.785],
            "outside": [-0.7, 0, 0, -2.0, 0, 2.0, 0.785],
        }),
    ],
    # Tools point down at the table; both poses "middle" are the same place.
    "two_shuttles": [
        Arm("left", SHUTTLE, "left_", {
            "middle": [0, 0.3, 0.4, 0, 0.87, 0],
            "left": [0.5, 0.2, 0.5, 0, 0.87, 1.0],
            "far": [0, 0.6, 0.2, 0, 0.77, 0],
            "right": [-0.5, 0.4, 0.4, 0, 0.77, -1.0],
        }),
        Arm("right", SHUTTLE, "right_", {
            "left": [0.5, 0.2, 0.5, 0, 0.87, 1.0],
            "middle": [0, 0.3, 0.4, 0, 0.87, 0],
            "right": [-0.5, 0.4, 0.4, 0, 0.77, -1.0],
            "far": [0, 0.6, 0.2, 0, 0.77, 0],
        }),
    ],
}


def duration(q0, q1, robot=PANDA):
    """Returns the duration of the straight move in seconds, a multiple of 10 ms."""
    longest = 0.5
    for a, b, velocity, acceleration in zip(q0, q1, robot.velocity_max, robot.acceleration_max):
        dq = abs(b - a)
        longest = max(longest, 15 / 8 * dq / (SHARE * velocity),
                      math.sqrt(10 / math.sqrt(3) * dq / (SHARE * acceleration)))
    return math.ceil(longest * 100) / 100


def quintic(joint_names, q0, q1, T=None):
    """Returns a trajectory for the body of POST /jobs; T (s) defaults to the duration for a Panda."""
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


def jobs(arms):
    listed = []
    for arm in arms:
        names = [arm.prefix + joint for joint in arm.robot.joints]
        home = arm.robot.home
        for n, (pose, q) in enumerate(arm.poses.items(), start=1):
            T = duration(home, q, arm.robot)
            listed.append((n, 0, f"{arm.name}-{n}-to-{pose}", f"{arm.name}: {pose}",
                           quintic(names, home, q, T)))
            listed.append((n, 1, f"{arm.name}-{n}-home", f"{arm.name}: {pose} -> home",
                           quintic(names, q, home, T)))
    listed.sort(key=lambda job: (job[0], job[1]))  # the arms take turns
    return [{"at": 0.0, "job": {"id": key, "name": name, "trajectory": trajectory}}
            for _, _, key, name, trajectory in listed]


def main():
    if len(sys.argv) != 2 or sys.argv[1] not in CELLS:
        sys.exit(__doc__)
    lines = ",\n".join(json.dumps(job, separators=(",", ":")) for job in jobs(CELLS[sys.argv[1]]))
    print(f"[\n{lines}\n]")


if __name__ == "__main__":
    main()
