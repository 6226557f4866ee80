"""Limits in MoveIt's joint_limits.yaml and homes that are states of the SRDF. The jobs are as fast as that
file allows, faster than the defaults. Loads without changes.
"""
import small_robots as small


def files(urdf_name):
    urdf = small.link("base", small.box((1.2, 0.1, 0.1), (0, -0.2, -0.2)))
    for side, xyz in small.SIDES.items():
        urdf += small.arm(side, "base", xyz)
    srdf = "".join(small.group(side, state=small.HOME[side]) + small.neighbours(side, "base")
                   for side in small.SIDES)
    limits = "default_velocity_scaling_factor: 0.1\njoint_limits:\n" + "".join(
        f"  {joint}:\n    has_velocity_limits: true\n    max_velocity: 1.5\n"
        "    has_acceleration_limits: true\n    max_acceleration: 5\n    has_jerk_limits: false\n"
        for side in small.SIDES for joint in (f"{side}_pan", f"{side}_bend"))
    arms = [{**arm, "home": "ready"} for arm in small.arms()]
    cell = small.cell("named_homes", arms, joint_limits="joint_limits.yaml")
    cell["robots"][0]["urdf"] = urdf_name
    return {urdf_name: small.robot("named", urdf), "robot.srdf": small.robot("named", srdf),
            "joint_limits.yaml": limits, "cell.json": cell, "jobs.json": small.jobs(velocity=1.5)}


def write(folder):
    small.write_files(folder, files("robot.urdf"))
