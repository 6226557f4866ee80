#!/usr/bin/env python3
"""Many arms on a circle, all jobs at once: run time of `armloom simulate` and makespan.

    test/bench/many_arms.py ARMLOOM [--robots panda,shuttle,fanuc] [--arms 8,10] [--jobs 96]
                            [--policies coordinated,earliest_start,certified] [--seed 1] [--out FOLDER]

The arms are on a circle and face its middle, which all of them visit: each moves from home to poses around
the middle and back. JOBS in total are submitted at time zero, in turn. Pandas are those of models/ (simple
shapes), Shuttles those of models/shuttle (meshes), Fanucs those of ../shared/data; if that folder is missing,
Fanucs are skipped with a message. Prints one line per cell and policy: makespan, job states, wall time of the
run, and the mean checking time per job of `armloom compare`. With --out the cell and jobs files are kept.
"""
import argparse
import csv
import json
import math
import pathlib
import random
import re
import subprocess
import sys
import tempfile

TOP = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(TOP / "config"))
import joint_moves  # noqa: E402

FANUC = TOP.parent / "shared/data/fanuc_description"


def robot_of(name, file):
    """Returns the first robot of a cell in config/."""
    text = re.sub(r"^\s*//.*$", "", (TOP / "config" / file).read_text(), flags=re.M)
    robot = json.loads(text)["robots"][0]
    for key in ("urdf", "srdf"):
        robot[key] = str((TOP / "config" / robot[key]).resolve())
    for package, path in robot.get("packages", {}).items():
        robot["packages"][package] = str((TOP / "config" / path).resolve())
    return dict(robot, name=name)


def fanuc():
    home = [0, -0.3, 0, 0, -1.2, 0]
    return {"urdf": str(FANUC / "urdf/fanuc.urdf"), "srdf": str(FANUC / "urdf/fanuc.srdf"),
            "packages": {"moveit_resources_fanuc_description": str(FANUC)},
            "arms": [{"name": "", "group": "manipulator", "home": home}],
            "controller": {"type": "sim", "lag_s": 0.02, "noise_rad": 0}}


def poses(cell, arm, *names):
    """Returns poses of an arm of config/joint_moves.py whose straight motions from home are clear."""
    of = next(each for each in joint_moves.CELLS[cell] if each.name == arm)
    return [of.poses[name] for name in names]


# By kind of robot:
# - the robot,
# - its data for joint_moves,
# - the radius of a circle of 8 arms (m),
# - the height of the bases (m),
# - the goals of trips,
# - the largest random change of the first joint at a goal (rad). The first joint of all robots is vertical.
KINDS = {
    "panda": (lambda: robot_of("panda", "two_pandas.json"), joint_moves.PANDA, 0.95, 0.1,
              poses("two_pandas", "left", "tiled_up", "twist_right", "tiled_down", "coop_down", "mirror"),
              0.4),
    "shuttle": (lambda: robot_of("shuttle", "two_shuttles.json"), joint_moves.SHUTTLE, 1.25, 0.0,
                poses("two_shuttles", "left", "middle", "left", "far", "right"), 0.3),
    "fanuc": (fanuc, joint_moves.Robot([f"joint_{i}" for i in range(1, 7)],
                                       [3.67, 3.32, 3.67, 6.98, 6.98, 10.47], [3.75] * 6,
                                       [0, -0.3, 0, 0, -1.2, 0]), 1.5, 0.0,
              [[0, 0.35, -0.1, 0, -1.4, 0], [0.2, 0.6, -0.2, 0.2, -1.2, 0.5],
               [-0.2, 0.1, 0.1, -0.2, -1.5, -0.5], [0, 0.8, -0.3, 0, -1.1, 1.0]], 0.3),
}


def cell_of(kind, arms):
    template, moves, radius_of_8, height, *_ = KINDS[kind]
    radius = radius_of_8 * max(1.0, arms / 8)
    robots = []
    for i in range(arms):
        angle = 2 * math.pi * i / arms
        robot = json.loads(json.dumps(template()))
        robot.update(name=f"arm{i}", prefix=f"arm{i}_",
                     base={"xyz": [radius * math.cos(angle), radius * math.sin(angle), height],
                           "rpy": [0, 0, angle - math.pi]})
        robot["arms"][0].update(name=f"arm{i}", home=moves.home)
        robots.append(robot)
    objects, allowed = [], []
    if kind == "panda":
        side = 2 * radius + 1
        objects = [{"name": "table", "box": [side, side, 0.1], "xyz": [0, 0, 0.05], "rpy": [0, 0, 0]}]
        allowed = [["table", f"arm{i}_panda_link0"] for i in range(arms)]
    return {"name": f"{arms} {kind}s", "robots": robots, "objects": objects,
            "allowed_collisions": allowed, "clearance_m": 0.02,
            "checking": {"time_step_s": 0.02, "tracking_error_rad": 0.001, "delay_s": 0.1},
            "scheduling": {"policy": "coordinated", "backlog_timeout_s": 600}}


def jobs_of(kind, arms, count, seed):
    _, moves, _, _, places, aside = KINDS[kind]
    draw = random.Random(seed)
    trips = [count // 2 // arms + (1 if i < count // 2 % arms else 0) for i in range(arms)]
    listed = []
    for i in range(arms):
        names = [f"arm{i}_{joint}" for joint in moves.joints]
        for n in range(trips[i]):
            q = list(draw.choice(places))
            q[0] += aside * (2 * draw.random() - 1)
            T = joint_moves.duration(moves.home, q, moves)
            for k, (way, a, b) in enumerate((("out", moves.home, q), ("home", q, moves.home))):
                listed.append((n, i, k, {"id": f"arm{i}-{n}-{way}",
                                         "trajectory": joint_moves.quintic(names, a, b, T)}))
    return [{"at": 0.0, "job": job} for *_, job in sorted(listed, key=lambda each: each[:3])]


def run(armloom, cell, jobs, policies, out):
    done = subprocess.run([armloom, "compare", "--cell", cell, "--jobs", jobs, "--policies",
                           ",".join(policies), "--out", out], capture_output=True, text=True)
    if done.returncode not in (0, 1):
        sys.exit(done.stderr)
    with open(pathlib.Path(out) / "compare.csv", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def told(kind, arms, row):
    jobs = int(row["jobs"])
    left = {state: int(row[state]) for state in ("canceled", "expired", "failed", "refused", "unfinished")
            if int(row[state])}
    print(f"{arms:2} {kind:8} {row['policy']:15} makespan {float(row['makespan_s'] or 'nan'):7.2f} s  "
          f"wall {float(row['wall_s']):6.2f} s  judging {1e3 * float(row['judging_s']) / jobs:6.2f} ms a job"
          f"  {int(row['judgements']) / jobs:4.1f} judgements, "
          f"{int(row['evaluations']) / jobs:6.0f} evaluations  stops {row['monitor_stops']}"
          f"  {left if left else ''}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("armloom")
    parser.add_argument("--robots", default="panda,shuttle,fanuc")
    parser.add_argument("--arms", default="8,10")
    parser.add_argument("--jobs", type=int, default=96)
    parser.add_argument("--policies", default="coordinated,earliest_start,certified")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(options.out or scratch)
        for kind in options.robots.split(","):
            if kind == "fanuc" and not FANUC.is_dir():
                print(f"fanuc: left out, {FANUC} is not there")
                continue
            for arms in map(int, options.arms.split(",")):
                at = folder / f"{kind}-{arms}"
                at.mkdir(parents=True, exist_ok=True)
                (at / "cell.json").write_text(json.dumps(cell_of(kind, arms), indent=1))
                (at / "jobs.json").write_text(
                    json.dumps(jobs_of(kind, arms, options.jobs, options.seed)))
                for row in run(options.armloom, at / "cell.json", at / "jobs.json",
                               options.policies.split(","), at / "compare"):
                    told(kind, arms, row)


if __name__ == "__main__":
    main()
