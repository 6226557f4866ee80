"""Continuous shoulder joints without <limit>, in a cell that uses one of the two arms. The cell needs one
line, that arm's velocity limit. The joints of the other arm need nothing; a warning says that they do not move.
"""
import small_robots as small

LINE = '"limits": {"left_pan": {"velocity_rad_s": 1}}'
WARNED = ("joint right_pan, right_bend is in no arm's group",)
TOLD = 'add to the arm "limits": {"left_pan": {"velocity_rad_s": 1}}'


def add_line(cell):
    cell["robots"][0]["arms"][0]["limits"] = {"left_pan": {"velocity_rad_s": 1}}


def write(folder):
    urdf = small.link("base", small.box((1.2, 0.1, 0.1), (0, -0.2, -0.2)))
    for side, xyz in small.SIDES.items():
        urdf += small.arm(side, "base", xyz, shoulder=("continuous", ""))
    srdf = "".join(small.group(side) + small.neighbours(side, "base") for side in small.SIDES)
    poses = {**small.POSES["left"], "back": [2.3, -0.5], "up": [1.6, 0.2], "out": [2.6, 0.1]}
    moves = small.joint_moves()
    arm = moves.Arm("left", moves.Robot(["left_pan", "left_bend"], [1, 2], [3.75] * 2,
                                        small.HOME["left"]), "", poses)
    small.write_files(folder, {
        "robot.urdf": small.robot("endless", urdf), "robot.srdf": small.robot("endless", srdf),
        "cell.json": small.cell("endless_shoulders", small.arms()[:1]),
        "jobs.json": moves.jobs([arm])})
