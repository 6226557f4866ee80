#!/usr/bin/env python3
"""A robot with two arms on a strongly concave body, which its links pass at 9 to 16 mm.

    python3 test/robots/concave_body.py FOLDER

Writes robot.urdf, robot.srdf, body.stl, cell.json and jobs.json (twelve moves). The body is a plate
with a round notch behind each shoulder; the upper arms' tails sweep through the notches, like a YuMi's past
its body. A few convex pieces cannot leave the notches open. Because the body carries the arms, the cell
allows the small distance with mount_clearance_m. Meters, radians, seconds.
"""
import importlib.util
import json
import math
import pathlib
import struct
import sys

CONFIG = pathlib.Path(__file__).resolve().parents[2] / "config"
SHOULDERS = {"left": -0.3, "right": 0.3}   # x, on the plate's front edge (y = 0)
TAIL = (0.11, 0.03)                        # length behind the shoulder, half its width
GAPS = {"left": 0.0095, "right": 0.0155}   # from the notch's wall to the tail's corners
LOW, HIGH, BACK, SIDE = 0.2, 0.4, -0.35, 0.55
FACETS = 24                                # of a notch
JOINTS = ("pan", "lift", "bend")
HOME = {"left": [2.2, 0, 0.4], "right": [0.94, 0, -0.4]}
POSES = {"left": {"middle": [0.8, 0, 0.5], "ahead": [1.5, 0.1, -0.6], "across": [0.65, -0.05, 0.9]},
         "right": {"middle": [2.34, 0, -0.5], "ahead": [1.64, 0.1, 0.6], "across": [2.49, -0.05, -0.9]}}


def radius(side):
    """Returns the notch's radius. It is enlarged, because the middle of a facet is closer to the tail than its corners."""
    return (math.hypot(*TAIL) + GAPS[side]) / math.cos(math.pi / 2 / FACETS)


def front_edge():
    """Returns (x, y) from left to right."""
    line = [(-SIDE, 0.0)]
    for side, x in SHOULDERS.items():
        for i in range(FACETS + 1):
            angle = math.pi * i / FACETS
            line.append((x - radius(side) * math.cos(angle), -radius(side) * math.sin(angle)))
    return line + [(SIDE, 0.0)]


def body_triangles():
    """Returns vertical strips between the front edge's corners and the back: closed, facing outwards."""
    front = [(x, min(y, 0.0)) for x, y in front_edge()]
    triangles = []

    def quad(a, b, c, d):
        triangles.extend([(a, b, c), (a, c, d)])

    for (x, y), (next_x, next_y) in zip(front, front[1:]):
        quad((x, BACK, HIGH), (next_x, BACK, HIGH), (next_x, next_y, HIGH), (x, y, HIGH))
        quad((x, BACK, LOW), (x, y, LOW), (next_x, next_y, LOW), (next_x, BACK, LOW))
        quad((x, y, LOW), (x, y, HIGH), (next_x, next_y, HIGH), (next_x, next_y, LOW))
        quad((x, BACK, LOW), (next_x, BACK, LOW), (next_x, BACK, HIGH), (x, BACK, HIGH))
    for x, turned in ((-SIDE, False), (SIDE, True)):
        corners = [(x, BACK, LOW), (x, BACK, HIGH), (x, 0.0, HIGH), (x, 0.0, LOW)]
        quad(*(reversed(corners) if turned else corners))
    return triangles


def stl(triangles):
    data = b"body".ljust(80) + struct.pack("<I", len(triangles))
    for triangle in triangles:
        data += struct.pack("<3f", 0, 0, 0)
        data += b"".join(struct.pack("<3f", *corner) for corner in triangle) + struct.pack("<H", 0)
    return data


def box(low, high, half):
    """Along x from low to high."""
    return (f'<collision><origin xyz="{(low + high) / 2:g} 0 0"/><geometry>'
            f'<box size="{high - low:g} {2 * half:g} {2 * half:g}"/></geometry></collision>')


def urdf():
    text = '<robot name="concave_body">\n<link name="body"><collision><geometry>'
    text += '<mesh filename="body.stl"/></geometry></collision></link>\n'
    for side, x in SHOULDERS.items():
        hub = ('<collision><geometry><cylinder radius="0.04" length="0.1"/></geometry></collision>')
        shapes = {"hub": hub, "upper": box(-TAIL[0], 0.3, TAIL[1]), "fore": box(0.02, 0.25, 0.025)}
        for link, shape in shapes.items():
            text += f'<link name="{side}_{link}">{shape}</link>\n'
        chain = [("pan", "body", f"{side}_hub", f"{x:g} 0 {(LOW + HIGH) / 2:g}", "0 0 1", 0.3, 2.84),
                 ("lift", f"{side}_hub", f"{side}_upper", "0 0 0", "0 1 0", -0.3, 0.3),
                 ("bend", f"{side}_upper", f"{side}_fore", "0.33 0 0", "0 0 1", -2.2, 2.2)]
        for name, parent, child, xyz, axis, lower, upper in chain:
            text += (f'<joint name="{side}_{name}" type="revolute"><origin xyz="{xyz}"/>'
                     f'<parent link="{parent}"/><child link="{child}"/><axis xyz="{axis}"/>'
                     f'<limit lower="{lower}" upper="{upper}" effort="50" velocity="2"/></joint>\n')
    return text + "</robot>\n"


def srdf():
    text = '<robot name="concave_body">\n'
    for side in SHOULDERS:
        joints = "".join(f'<joint name="{side}_{joint}"/>' for joint in JOINTS)
        text += f'<group name="{side}_arm">{joints}</group>\n'
        for one, other in (("body", f"{side}_hub"), (f"{side}_hub", f"{side}_upper"),
                           (f"{side}_upper", f"{side}_fore")):
            text += f'<disable_collisions link1="{one}" link2="{other}" reason="Adjacent"/>\n'
    return text + "</robot>\n"


def cell():
    arms = [{"name": side, "group": f"{side}_arm", "home": HOME[side]} for side in SHOULDERS]
    return {"name": "concave_body",
            "robots": [{"name": "robot", "urdf": "robot.urdf", "srdf": "robot.srdf", "arms": arms}],
            "clearance_m": 0.02, "mount_clearance_m": 0.005, "scheduling": {"policy": "coordinated", "on_idle_blocker": "park"}}


def jobs():
    """Moves each arm to each of its poses and back home."""
    spec = importlib.util.spec_from_file_location("joint_moves", CONFIG / "joint_moves.py")
    moves = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(moves)
    listed = []
    for side in SHOULDERS:
        robot = moves.Robot([f"{side}_{joint}" for joint in JOINTS], [2.0] * 3, [3.75] * 3, HOME[side])
        listed.append(moves.Arm(side, robot, "", POSES[side]))
    return moves.jobs(listed)


def write(folder):
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "body.stl").write_bytes(stl(body_triangles()))
    (folder / "robot.urdf").write_text(urdf())
    (folder / "robot.srdf").write_text(srdf())
    (folder / "cell.json").write_text(json.dumps(cell(), indent=1) + "\n")
    (folder / "jobs.json").write_text(json.dumps(jobs(), indent=1) + "\n")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    write(sys.argv[1])
