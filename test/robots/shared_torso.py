"""Two arms on one lifting torso, and continuous shoulder joints without <limit>.

The cell needs one line: the torso is fixed. (The shoulders' velocity limits are in joint_limits.yaml, as usual
with MoveIt.)
"""
import small_robots as small

LINE = '"fixed": {"torso_lift": 0.2}'
TOLD = 'add to the robot "fixed": {"torso_lift": 0.1}'  # the message without the line


def add_line(cell):
    cell["robots"][0]["fixed"] = {"torso_lift": 0.2}


def write(folder):
    lift = '<limit lower="0.1" upper="0.5" effort="100" velocity="0.1"/>'
    urdf = small.link("base", small.box((0.3, 0.3, 0.1), (0, 0, -0.3)))
    urdf += small.link("torso", small.box((1.2, 0.1, 0.1), (0, -0.2, -0.2)))
    urdf += small.joint("torso_lift", "base", "torso", (0, 0, 0.4), "prismatic", inside=lift)
    for side, xyz in small.SIDES.items():
        urdf += small.arm(side, "torso", xyz, shoulder=("continuous", ""))
    srdf = "".join(small.group(side) + small.neighbours(side, "torso") for side in small.SIDES)
    srdf += small.allowed(("base", "torso"))
    limits = "joint_limits:\n" + "".join(
        f"  {side}_pan:\n    has_velocity_limits: true\n    max_velocity: 2\n"
        "    has_acceleration_limits: false\n    max_acceleration: 0\n" for side in small.SIDES)
    small.write_files(folder, {
        "robot.urdf": small.robot("torso_robot", urdf), "robot.srdf": small.robot("torso_robot", srdf),
        "joint_limits.yaml": limits,
        "cell.json": small.cell("shared_torso", small.arms(), joint_limits="joint_limits.yaml"),
        "jobs.json": small.jobs()})
