"""Forearm meshes at file:// addresses, as ROS 2 launch files write them, in a separate description package
outside of the URDF's folder. The cell names that folder.
"""
import small_robots as small

FOLDER = None  # of the package, set by write()


def line():
    return f'"packages": {{"arm_description": "{FOLDER}"}}'


def told():
    return "add to the robot " + line()


def add_line(cell):
    cell["robots"][0]["packages"] = {"arm_description": str(FOLDER)}


def write(folder):
    global FOLDER
    FOLDER = (folder / "arm_description").resolve()
    fore = small.mesh(f"file://{FOLDER}/meshes/collision/fore.stl")
    urdf = small.link("base", small.box((1.2, 0.1, 0.1), (0, -0.2, -0.2)))
    for side, xyz in small.SIDES.items():
        urdf += small.arm(side, "base", xyz, fore=fore)
    srdf = "".join(small.group(side) + small.neighbours(side, "base") for side in small.SIDES)
    cell = small.cell("file_mesh", small.arms())
    cell["robots"][0] |= {"urdf": "urdf/robot.urdf", "srdf": "urdf/robot.srdf"}
    small.write_files(folder, {
        "arm_description/meshes/collision/fore.stl":
            small.stl_box((small.FORE, 0.06, 0.06), (small.FORE / 2 + 0.02, 0, 0)),
        "urdf/robot.urdf": small.robot("meshed", urdf), "urdf/robot.srdf": small.robot("meshed", srdf),
        "cell.json": cell, "jobs.json": small.jobs()})
