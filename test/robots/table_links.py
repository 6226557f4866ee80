#!/usr/bin/env python3
"""Two small arms whose table and shelf are links of their URDF, as in MoveIt's dual-arm configurations.

    python3 test/robots/table_links.py FOLDER

Writes robot.urdf, robot.srdf, cell.json, and jobs.json (twelve feasible jobs). Meters, radians, seconds.
"""
import json
import math
import pathlib
import sys

UPPER, FORE, HAND, SHOULDER_Z = 0.35, 0.3, 0.2, 0.32  # the hand's length includes the finger
SIDES = {"left": 0.3, "right": -0.3}  # y of each arm's base; the table's top is at z = 0
BOXES = {  # size, middle
    "table": [((1.6, 1.6, 0.04), (0.4, 0, -0.02))],
    "shelf": [((0.2, 1.2, 0.02), (0.62, 0, 0.12)), ((0.16, 1.2, 0.02), (0.72, 0, 0.46)),
              ((0.02, 1.2, 0.5), (0.81, 0, 0.25))],
}
JOINTS = ("turn", "lift", "bend", "tilt")
HOME = (0.25, 0.25)  # of the finger's tip: out, up
SEGMENT_S = 1.6


def text_of(values):
    return " ".join(f"{value:g}" for value in values)


def solid(shape, xyz):
    return f'<collision><origin xyz="{text_of(xyz)}"/><geometry>{shape}</geometry></collision>'


def box(size):
    return f'<box size="{text_of(size)}"/>'


def cylinder(radius, length):
    return f'<cylinder radius="{radius:g}" length="{length:g}"/>'


def arm(side, y):
    def joint(name, parent, child, z, axis):
        return (f'  <joint name="{side}_{name}" type="revolute">\n'
                f'    <parent link="{side}_{parent}"/><child link="{side}_{child}"/>\n'
                f'    <origin xyz="0 0 {z:g}"/><axis xyz="{axis}"/>\n'
                '    <limit lower="-3" upper="3" effort="50" velocity="2"/>\n  </joint>\n')

    def link(name, shape, z):
        return f'  <link name="{side}_{name}">{solid(shape, (0, 0, z))}</link>\n'

    return (f'  <joint name="{side}_mount" type="fixed">\n'
            f'    <parent link="world"/><child link="{side}_base"/><origin xyz="0 {y:g} 0"/>\n'
            '  </joint>\n'
            + link("base", cylinder(0.08, 0.2), 0.1)
            + joint("turn", "base", "shoulder", 0.2, "0 0 1")
            + link("shoulder", cylinder(0.07, 0.1), 0.07)
            + joint("lift", "shoulder", "upper", 0.12, "0 1 0")
            + link("upper", cylinder(0.05, 0.26), 0.19)
            + joint("bend", "upper", "fore", UPPER, "0 1 0")
            + link("fore", cylinder(0.04, 0.2), 0.15)
            + joint("tilt", "fore", "hand", FORE, "0 1 0")
            + link("hand", box((0.06, 0.06, 0.1)), 0.07)
            + f'  <joint name="{side}_grip" type="fixed">\n'
            f'    <parent link="{side}_hand"/><child link="{side}_finger"/><origin xyz="0 0 0.12"/>\n'
            '  </joint>\n' + link("finger", box((0.02, 0.02, 0.08)), 0.04))


def urdf():
    parts = ['<?xml version="1.0"?>\n<robot name="table_links">\n  <link name="world"/>\n']
    for name, boxes in BOXES.items():
        parts.append(f'  <joint name="{name}_stands" type="fixed">\n'
                     f'    <parent link="world"/><child link="{name}"/>\n  </joint>\n'
                     f'  <link name="{name}">\n'
                     + "".join(f"    {solid(box(size), middle)}\n" for size, middle in boxes)
                     + "  </link>\n")
    return "".join(parts + [arm(side, y) for side, y in SIDES.items()]) + "</robot>\n"


def srdf():
    links = ("base", "shoulder", "upper", "fore", "hand", "finger")
    parts = ['<?xml version="1.0"?>\n<robot name="table_links">\n']
    for side in SIDES:
        parts.append(f'  <group name="{side}_arm">\n' + "".join(
            f'    <joint name="{side}_{joint}"/>\n' for joint in JOINTS) + "  </group>\n")
        parts += [f'  <disable_collisions link1="{side}_{a}" link2="{side}_{b}" reason="Adjacent"/>\n'
                  for a, b in zip(links, links[1:])]
    return "".join(parts) + "</robot>\n"


def pose(turn, out, up):
    """Returns the joints for the fingertip, pointing down, `out` from the arm's axis and `up`."""
    down = up + HAND - SHOULDER_Z
    reach = math.hypot(out, down)
    bend = math.acos((reach ** 2 - UPPER ** 2 - FORE ** 2) / (2 * UPPER * FORE))
    lift = math.atan2(out, down) - math.atan2(FORE * math.sin(bend), UPPER + FORE * math.cos(bend))
    return [turn, lift, bend, math.pi - lift - bend]


def job(name, side, places):
    """Moves from home through the places and back home, with a rest at each."""
    points = [pose(0, *HOME), *places, pose(0, *HOME)]
    still = [0.0] * len(JOINTS)
    return {"at": 0.0, "job": {"id": name, "trajectory": {
        "joint_names": [f"{side}_{joint}" for joint in JOINTS],
        "points": [{"positions": q, "velocities": still, "accelerations": still,
                    "time_from_start": i * SEGMENT_S} for i, q in enumerate(points)]}}}


def to_and_fro(name, side, turn, out, up):
    above = pose(turn, out, up + 0.08)
    return job(name, side, [above, pose(turn, out, up), above])


def inwards(side):
    return -1 if side == "left" else 1


def twelve_jobs():
    jobs = []
    for n in range(2):
        for side in SIDES:
            jobs += [to_and_fro(f"{side}-middle-{n}", side, 0.6 * inwards(side), 0.45, 0.03),
                     to_and_fro(f"{side}-ahead-{n}", side, 0, 0.42, 0.04),
                     to_and_fro(f"{side}-shelf-{n}", side, 0, 0.56, 0.16)]
    return jobs


def cell():
    arms = [{"name": side, "group": f"{side}_arm", "home": pose(0, *HOME)} for side in SIDES]
    return {"name": "table_links",
            "robots": [{"name": "pair", "urdf": "robot.urdf", "srdf": "robot.srdf", "prefix": "",
                        "base": {"xyz": [0, 0, 0], "rpy": [0, 0, 0]}, "arms": arms}],
            "clearance_m": 0.02,
            "scheduling": {"policy": "coordinated", "backlog_timeout_s": 60},
            "monitor": {"rate_hz": 100, "reaction_s": 0.02, "stop_clearance_m": 0.01}}


def write(folder):
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    texts = {"robot.urdf": urdf(), "robot.srdf": srdf(),
             "cell.json": json.dumps(cell(), indent=1), "jobs.json": json.dumps(twelve_jobs(), indent=1)}
    for name, text in texts.items():
        (folder / name).write_text(text)


if __name__ == "__main__":
    write(sys.argv[1])
