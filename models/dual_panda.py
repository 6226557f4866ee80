#!/usr/bin/env python3
"""Two Pandas in one robot: writes dual_panda.urdf and dual_panda.srdf from panda.urdf and panda.srdf.

    python3 models/dual_panda.py [FOLDER]

They go to FOLDER, or beside this script. Both arms stand on one static plate, base_link, with
their links and joints named left_panda_* and right_panda_*, and the groups left_arm, left_hand,
right_arm and right_hand. What the SRDF says of one Panda holds for each; pairs between the arms
stay enabled.
"""
import pathlib
import re
import sys

HERE = pathlib.Path(__file__).resolve().parent
NOTE = "Written by models/dual_panda.py from models/panda.{}: change those, not this file."
RESERVE = "The shapes are those of panda.urdf, and a box, the plate; reserve: 0 mm."

SIDES = {"left": "0 0.35 0", "right": "0 -0.35 0"}  # where each arm stands on the plate
PLATE = """  <!-- A steel plate, whose top is at height zero; both arms are bolted to it. -->
  <link name="base_link">
    <visual><origin xyz="-0.03 0 -0.01"/><geometry><box size="0.36 1.06 0.02"/></geometry><material name="grey"/></visual>
    <collision><origin xyz="-0.03 0 -0.01"/><geometry><box size="0.36 1.06 0.02"/></geometry></collision>
  </link>
"""


def urdf():
    source = (HERE / "panda.urdf").read_text()
    materials, arm = re.search(r'<robot name="panda">\n(.*?)\n\n(.*)</robot>', source,
                               re.DOTALL).groups()
    plate = re.sub(r'<material name="(\w+)"/>',
                   lambda use: re.search(f'<material name="{use[1]}">.*?</material>', materials)[0],
                   PLATE)
    parts = [f'<?xml version="1.0"?>\n<!-- {NOTE.format("urdf")}\n     {RESERVE} -->\n<robot name="dual_panda">',
             materials, "", plate]
    for side, xyz in SIDES.items():
        parts += [f'  <joint name="{side}_mount" type="fixed">',
                  f'    <parent link="base_link"/><child link="{side}_panda_link0"/>',
                  f'    <origin xyz="{xyz}" rpy="0 0 0"/>', "  </joint>",
                  arm.replace("panda_", f"{side}_panda_")]
    return "\n".join(parts) + "</robot>\n"


def srdf():
    source = re.search(r'<robot name="panda">\n(.*)</robot>', (HERE / "panda.srdf").read_text(),
                       re.DOTALL).group(1)
    parts = [f'<?xml version="1.0"?>\n<!-- {NOTE.format("srdf")} -->\n<robot name="dual_panda">']
    for side in SIDES:
        arm = source.replace("panda_arm", "arm").replace("panda_", f"{side}_panda_")
        arm = re.sub(r'(group|parent_group|group name|end_effector name)="(arm|hand)"',
                     rf'\1="{side}_\2"', arm)
        arm = re.sub(r"  <virtual_joint.*?/>\n", "", arm)  # one for the whole robot, below
        parts += [arm, f'  <disable_collisions link1="base_link" link2="{side}_panda_link0" '
                  'reason="Adjacent"/>\n']
    parts.append('  <virtual_joint name="virtual_joint" type="fixed" parent_frame="world" '
                 'child_link="base_link"/>')
    return "\n".join(parts) + "\n</robot>\n"


folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else HERE
(folder / "dual_panda.urdf").write_text(urdf())
(folder / "dual_panda.srdf").write_text(srdf())
