"""The robot of named_homes.py as xacro: each arm by a macro, the reach by a property."""
import shutil

import named_homes
import small_robots as small

NEEDS = None if shutil.which("xacro") else "xacro"


def write(folder):
    files = named_homes.files("robot.urdf.xacro")
    urdf = files["robot.urdf.xacro"].replace("<robot ", '<robot xmlns:xacro="http://www.ros.org/wiki/xacro" ')
    urdf = urdf.replace('upper="2.8"', 'upper="${reach}"')
    urdf = urdf.replace('xacro">\n', 'xacro">\n<xacro:property name="reach" value="2.8"/>\n')
    small.write_files(folder, {**files, "robot.urdf.xacro": urdf})
