"""An outdated SRDF: links, joints and groups that are no longer in the URDF, and another robot's name. Loads
without changes, with a warning for each.
"""
import small_robots as small

WARNED = ["the SRDF is for robot old_robot, but robot.urdf for robot new_robot",
          "robot.srdf: disable_collisions: 3 of 7 name links that are not in robot.urdf",
          "group left_arm: joint left_twist is not in robot.urdf; it is left out of the group",
          "group both: group hand does not exist; it is left out of the group",
          "group_state folded of hand: group hand does not exist; the state is left out",
          ": passive_joint: joint "]


def write(folder):
    urdf = small.link("base", small.box((1.2, 0.1, 0.1), (0, -0.2, -0.2)))
    for side, xyz in small.SIDES.items():
        urdf += small.arm(side, "base", xyz)
    srdf = (small.group("left", ["left_pan", "left_bend", "left_twist"]) + small.group("right")
            + '<group name="both"><group name="left_arm"/><group name="hand"/></group>\n'
            + '<group_state name="folded" group="hand"><joint name="finger" value="0"/></group_state>\n'
            + '<passive_joint name="caster"/>\n<end_effector name="hand" parent_link="x" group="hand"/>\n'
            + small.neighbours("left", "base") + small.neighbours("right", "base")
            + small.allowed(("left_fore", "left_hand"), ("hand", "camera"), ("base", "mast")))
    small.write_files(folder, {
        "robot.urdf": small.robot("new_robot", urdf), "robot.srdf": small.robot("old_robot", srdf),
        "cell.json": small.cell("stale_srdf", small.arms()), "jobs.json": small.jobs()})
