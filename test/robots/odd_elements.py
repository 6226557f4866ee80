"""Oddities that MoveIt ignores: unknown elements, unused numbers, a head whose joint has velocity 0, wheels
without limits, a floating root. One elbow that an arm needs has velocity 0: the cell must set its limit.
"""
import small_robots as small

LINE = '"limits": {"right_bend": {"velocity_rad_s": 1}}'
TOLD = 'add to the arm "limits": {"right_bend": {"velocity_rad_s": 1}}'
WARNED = ["<gravity> is not known here and is left out",
          "joint type floating is not supported: the joint is fixed at its origin, and the links below it "
          "are checked there",
          "mass value is 'heavy', not a finite number; masses play no part in the checks"]


def add_line(cell):
    cell["robots"][0]["arms"][1]["limits"] = {"right_bend": {"velocity_rad_s": 1}}


def write(folder):
    still = '<limit lower="-1" upper="1" effort="0" velocity="0"/>'
    urdf = '<transmission name="t"><type>x</type></transmission>\n<gazebo reference="base"/>\n'
    urdf += '<ros2_control name="c" type="system"><hardware/></ros2_control>\n'
    urdf += small.link("world")
    urdf += small.link("base", small.box((1.2, 0.1, 0.1), (0, -0.2, -0.2)) + "<gravity>0</gravity>"
                       + '<inertial><mass value="heavy"/></inertial>')
    urdf += small.link("head", small.box((0.1, 0.1, 0.1))) + small.link("wheel")
    urdf += small.joint("floats", "world", "base", (0, 0, 1), "floating", inside="")
    urdf += small.joint("nod", "base", "head", (0, -0.6, 0.2), inside=still)
    urdf += small.joint("roll", "base", "wheel", (0, -0.6, -0.3), "continuous",
                        inside='<safety_controller k_velocity="1"/><limit effort="1"/>')
    urdf += small.arm("left", "base", small.SIDES["left"])
    urdf += small.arm("right", "base", small.SIDES["right"],
                      elbow=("revolute", small.REACH.replace('velocity="2"', 'velocity="0"')))
    srdf = "".join(small.group(side) + small.neighbours(side, "base") for side in small.SIDES)
    srdf += small.allowed(("base", "head"), ("base", "wheel"))
    small.write_files(folder, {
        "robot.urdf": small.robot("odd", urdf), "robot.srdf": small.robot("odd", srdf),
        "cell.json": small.cell("odd_elements", small.arms()), "jobs.json": small.jobs(velocity=1.0)})
