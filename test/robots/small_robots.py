"""Building blocks of the small robots: elements of a URDF, an SRDF, cells and jobs.

Meters, radians, seconds. This module writes no robot itself.
"""
import importlib.util
import json
import pathlib

CONFIG = pathlib.Path(__file__).resolve().parents[2] / "config"


def joint_moves():
    """Loads config/joint_moves.py as a module."""
    spec = importlib.util.spec_from_file_location("joint_moves", CONFIG / "joint_moves.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def box(size, xyz=(0, 0, 0)):
    text = " ".join(map(str, size))
    return (f'<collision><origin xyz="{" ".join(map(str, xyz))}"/>'
            f'<geometry><box size="{text}"/></geometry></collision>')


def mesh(uri):
    return f'<collision><geometry><mesh filename="{uri}"/></geometry></collision>'


def link(name, inside=""):
    return f'<link name="{name}">{inside}</link>\n'


REACH = '<limit lower="-2.8" upper="2.8" effort="10" velocity="2"/>'


def joint(name, parent, child, xyz=(0, 0, 0), kind="revolute", axis="0 0 1", inside=REACH):
    return (f'<joint name="{name}" type="{kind}">'
            f'<origin xyz="{" ".join(map(str, xyz))}"/><parent link="{parent}"/>'
            f'<child link="{child}"/><axis xyz="{axis}"/>{inside}</joint>\n')


UPPER, FORE = 0.35, 0.3  # lengths of an arm's two links


def arm(side, mount, xyz, shoulder=("revolute", REACH), elbow=("revolute", REACH), fore=None):
    """Returns two links that turn about z above the mount: <side>_pan and <side>_bend."""
    return (link(f"{side}_upper", box((UPPER, 0.08, 0.06), (UPPER / 2, 0, 0)))
            + link(f"{side}_fore", fore or box((FORE, 0.06, 0.06), (FORE / 2 + 0.02, 0, 0)))
            + joint(f"{side}_pan", mount, f"{side}_upper", xyz, shoulder[0], inside=shoulder[1])
            + joint(f"{side}_bend", f"{side}_upper", f"{side}_fore", (UPPER + 0.06, 0, 0), elbow[0],
                    inside=elbow[1]))


def robot(name, inside):
    return f'<?xml version="1.0"?>\n<robot name="{name}">\n{inside}</robot>\n'


def group(side, joints=None, state=None):
    joints = joints or [f"{side}_pan", f"{side}_bend"]
    text = f'<group name="{side}_arm">' + "".join(f'<joint name="{j}"/>' for j in joints) + "</group>\n"
    if state:
        text += (f'<group_state name="ready" group="{side}_arm">'
                 + "".join(f'<joint name="{j}" value="{q}"/>' for j, q in zip(joints, state))
                 + "</group_state>\n")
    return text


def allowed(*pairs):
    return "".join(f'<disable_collisions link1="{a}" link2="{b}" reason="Adjacent"/>\n'
                   for a, b in pairs)


def neighbours(side, mount):
    return allowed((mount, f"{side}_upper"), (f"{side}_upper", f"{side}_fore"))


# Two arms, 1 m apart along x. At home they point away from each other; the poses reach into the middle.
HOME = {"left": [2.0, 0.4], "right": [1.14, -0.4]}
POSES = {"left": {"middle": [0.35, -0.7], "ahead": [0.8, 0.3], "across": [-0.2, 0.5]},
         "right": {"middle": [2.79, 0.7], "ahead": [2.3, -0.3], "across": [-2.79, -0.5]}}
SIDES = {"left": (-0.5, 0, 0), "right": (0.5, 0, 0)}  # mounts


def cell(name, arms, **of_robot):
    return {"name": name,
            "robots": [{"name": "robot", "urdf": "robot.urdf", "srdf": "robot.srdf",
                        "arms": arms, **of_robot}],
            "clearance_m": 0.02, "scheduling": {"policy": "coordinated", "on_idle_blocker": "park"}}


def arms(**of_each):
    return [{"name": side, "group": f"{side}_arm", "home": HOME[side], **of_each} for side in SIDES]


def jobs(velocity=2.0, poses=POSES):
    """Returns twelve jobs: each arm to each of its poses and back home."""
    moves = joint_moves()
    listed = [moves.Arm(side, moves.Robot([f"{side}_pan", f"{side}_bend"], [velocity] * 2,
                                          [3.75] * 2, HOME[side]), "", poses[side])
              for side in SIDES]
    return moves.jobs(listed)


def write_files(folder, files):
    folder.mkdir(parents=True, exist_ok=True)
    for name, content in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        if isinstance(content, bytes):
            path.write_bytes(content)
        else:
            path.write_text(content if isinstance(content, str) else json.dumps(content, indent=1) + "\n")


def stl_box(size, xyz=(0, 0, 0)):
    """Returns a box as binary STL."""
    import struct
    corners = [tuple(xyz[i] + size[i] * (((k >> i) & 1) - 0.5) for i in range(3)) for k in range(8)]
    faces = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    data = b"box".ljust(80) + struct.pack("<I", 12)
    for a, b, c, d in faces:
        for triangle in ((a, b, c), (a, c, d)):
            data += struct.pack("<3f", 0, 0, 0)
            for corner in triangle:
                data += struct.pack("<3f", *corners[corner])
            data += struct.pack("<H", 0)
    return data
