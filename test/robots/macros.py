"""The robot of named_homes.py as xacro: its arms are a macro in a separate file with a property for their
reach; the SRDF is xacro too."""
import shutil

import named_homes
import small_robots as small

NEEDS = None if shutil.which("xacro") else "xacro"
XMLNS = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'


def xacro(name, inside):
    return small.robot(name, inside).replace("<robot ", f"<robot {XMLNS} ")


def write(folder):
    files = named_homes.files("robot.urdf.xacro")
    reach = small.REACH.replace("2.8", "${reach}")
    arm = small.arm("${side}", "${mount}", ("${x}", 0, 0), ("revolute", reach), ("revolute", reach))
    files["arm.xacro"] = xacro("arm", '<xacro:property name="reach" value="${14 / 5}"/>\n'
                               f'<xacro:macro name="arm" params="side mount x">\n{arm}</xacro:macro>\n')
    base = small.link("base", small.box((1.2, 0.1, 0.1), (0, -0.2, -0.2)))
    files["robot.urdf.xacro"] = xacro("named", '<xacro:include filename="arm.xacro"/>\n' + base + "".join(
        f'<xacro:arm side="{side}" mount="base" x="{xyz[0]}"/>\n' for side, xyz in small.SIDES.items()))
    files["robot.srdf.xacro"] = files.pop("robot.srdf").replace("<robot ", f"<robot {XMLNS} ")
    files["cell.json"]["robots"][0]["srdf"] = "robot.srdf.xacro"
    small.write_files(folder, files)
