"""Damaged robot files: one small sound cell, and what can be wrong with each of its files.

A Damage replaces one piece of one file (`old`, which occurs once) and says what has to be told:
each of `told` in what Armloom prints. Damages of one file are independent when their pieces do not
overlap, none of them hides the rest (`hides`) and they are not of one `subject`.
"""
from typing import NamedTuple

import small_robots as small

URDF = """<?xml version="1.0"?>
<robot name="pair">
<link name="base"><collision><origin xyz="0 -0.2 -0.2" rpy="0 0 0"/><geometry><box size="1.2 0.1 0.1"/></geometry></collision></link>
<link name="left_upper"><collision><origin xyz="0.175 0 0"/><geometry><cylinder radius="0.03" length="0.2"/></geometry></collision></link>
<link name="left_fore"><collision><geometry><sphere radius="0.04"/></geometry></collision></link>
<link name="left_finger"/>
<link name="left_thumb"/>
<link name="right_upper"><collision><geometry><box size="0.3 0.08 0.06"/></geometry></collision></link>
<link name="right_fore"><collision><geometry><mesh filename="package://meshes/fore.stl" scale="1 1 1"/></geometry></collision></link>
<joint name="left_pan" type="revolute"><origin xyz="-0.5 0 0" rpy="0 0 0.1"/><parent link="base"/><child link="left_upper"/><axis xyz="0 0 1"/><limit lower="-2.8" upper="2.8" effort="10" velocity="2"/></joint>
<joint name="left_bend" type="revolute"><origin xyz="0.41 0 0"/><parent link="left_upper"/><child link="left_fore"/><axis xyz="0 0 1.0"/><limit lower="-2.7" upper="2.7" effort="10" velocity="2.1"/></joint>
<joint name="left_grip" type="prismatic"><origin xyz="0.1 0 0"/><parent link="left_fore"/><child link="left_finger"/><axis xyz="0 1 0"/><limit lower="0" upper="0.04" effort="10" velocity="0.2"/></joint>
<joint name="left_mirror" type="prismatic"><origin xyz="0.1 0.1 0"/><parent link="left_fore"/><child link="left_thumb"/><axis xyz="0 -1 0"/><limit lower="0" upper="0.04" effort="10" velocity="0.2"/><mimic joint="left_grip" multiplier="2"/></joint>
<joint name="right_pan" type="revolute"><origin xyz="0.5 0 0"/><parent link="base"/><child link="right_upper"/><axis xyz="0 0 1"/><limit lower="-2.6" upper="2.6" effort="10" velocity="2.2"/></joint>
<joint name="right_bend" type="continuous"><origin xyz="0.42 0 0"/><parent link="right_upper"/><child link="right_fore"/><axis xyz="0 0.0 1"/><limit effort="10" velocity="2.3"/></joint>
</robot>
"""
SRDF = """<?xml version="1.0"?>
<robot name="pair">
<group name="left_arm"><joint name="left_pan"/><joint name="left_bend"/></group>
<group name="right_arm"><chain base_link="base" tip_link="right_fore"/></group>
<group_state name="ready" group="right_arm"><joint name="right_pan" value="1.2"/><joint name="right_bend" value="-0.4"/></group_state>
<disable_collisions link1="base" link2="left_upper" reason="Adjacent"/>
<disable_collisions link1="base" link2="right_upper" reason="Adjacent"/>
<disable_collisions link1="left_upper" link2="left_fore" reason="Adjacent"/>
<disable_collisions link1="right_upper" link2="right_fore" reason="Adjacent"/>
</robot>
"""
LIMITS = """joint_limits:
  left_pan:
    has_velocity_limits: true
    max_velocity: 1.9
  left_bend:
    has_acceleration_limits: true
    max_acceleration: 4.5
  right_pan:
    has_position_limits: true
    min_position: -2.5
    max_position: 2.5
  right_bend:
    has_jerk_limits: true
    max_jerk: 900
"""
CELL = """{"name": "pair",
 "robots": [{"name": "robot", "urdf": "robot.urdf", "srdf": "robot.srdf", "prefix": "r_",
   "joint_limits": "joint_limits.yaml",
   "base": {"xyz": [0, 0, 1]},
   "packages": {"meshes": "meshes"},
   "fixed": {"left_grip": 0.01},
   "arms": [{"name": "left", "group": "left_arm", "home": [2.0, 0.4],
             "limits": {"left_pan": {"velocity_rad_s": 1.8}}},
            {"name": "right", "group": "right_arm", "home": "ready"}],
   "controller": {"type": "sim", "lag_s": 0.02}}],
 "objects": [{"name": "block", "box": [0.1, 0.2, 0.3], "xyz": [0, 2, 0]}],
 "allowed_collisions": [["r_base", "block"]],
 "clearance_m": 0.02,
 "checking": {"time_step_s": 0.05, "delay_s": 0.1},
 "scheduling": {"policy": "coordinated"},
 "monitor": {"rate_hz": 100, "stop_clearance_m": 0.01}}
"""
FORE = small.stl_box((0.3, 0.06, 0.06), (0.17, 0, 0))
FILES = {"robot.urdf": URDF, "robot.srdf": SRDF, "joint_limits.yaml": LIMITS, "cell.json": CELL,
         "meshes/fore.stl": FORE}


class Damage(NamedTuple):
    file: str
    old: str
    new: str
    told: tuple
    subject: str = ""   # two damages of one subject say one thing, or one hides the other
    hides: bool = False  # the rest of the file cannot be read


def urdf(old, new, *told, **more):
    return Damage("robot.urdf", old, new, told, **more)


def srdf(old, new, *told, **more):
    return Damage("robot.srdf", old, new, told, **more)


def limits(old, new, *told, **more):
    return Damage("joint_limits.yaml", old, new, told, **more)


def cell(old, new, *told, **more):
    return Damage("cell.json", old, new, told, **more)


def of_numbers():
    """Every number of the URDF that the model is made of, as no number."""
    places = [("link base", 'xyz="0 -0.2 -0.2"', 'xyz="{}"', "origin xyz"),
              ("link base", 'size="1.2 0.1 0.1"', 'size="{}"', "box size"),
              ("link left_upper", 'radius="0.03"', 'radius="{}"', "cylinder radius"),
              ("link left_upper", 'length="0.2"', 'length="{}"', "cylinder length"),
              ("link left_fore", 'radius="0.04"', 'radius="{}"', "sphere radius"),
              ("link right_fore", 'scale="1 1 1"', 'scale="{}"', "mesh scale"),
              ("joint left_pan", 'xyz="-0.5 0 0"', 'xyz="{}"', "origin xyz"),
              ("joint left_pan", 'rpy="0 0 0.1"', 'rpy="{}"', "origin rpy"),
              ("joint left_bend", 'axis xyz="0 0 1.0"', 'axis xyz="{}"', "axis xyz"),
              ("joint left_mirror", 'multiplier="2"', 'multiplier="{}"', "mimic multiplier"),
              ("joint left_bend", 'lower="-2.7"', 'lower="{}"', "limit lower"),
              ("joint right_pan", 'upper="2.6"', 'upper="{}"', "limit upper"),
              ("joint left_bend", 'velocity="2.1"', 'velocity="{}"', "limit velocity"),
              ("joint right_bend", 'velocity="2.3"', 'velocity="{}"', "limit velocity")]
    for place, old, new, what in places:
        for bad in ("nan", "1,5 2", "0x10 0 0"):
            told = [f"robot.urdf: {place}: {what} is '{bad}', not"]
            if what.startswith("limit"):
                told.append('add to the arm "limits": ' if "right" in place else 'add to the arm\'s "limits" ')
            if old == 'upper="2.6"':
                told = told[:1]  # joint_limits.yaml says it
                continue
            yield urdf(old, new.format(bad), *told)


def of_urdf():
    yield from of_numbers()
    yield urdf('size="0.3 0.08 0.06"', 'size="0.3 -0.08 0.06"', "robot.urdf: link right_upper: box size is -0.08 m, it must be greater than 0")
    yield urdf('<sphere radius="0.04"/>', '<capsule radius="0.04" length="1"/>', "robot.urdf: link left_fore: collision geometry <capsule> is not supported")
    yield urdf('<geometry><sphere radius="0.04"/></geometry>', '', "robot.urdf: link left_fore: <geometry> is missing")
    yield urdf('<sphere radius="0.04"/>', '', "robot.urdf: link left_fore: collision geometry is empty")
    yield urdf(' length="0.2"', '', "robot.urdf: link left_upper: cylinder length is missing")
    yield urdf('package://meshes/fore.stl', 'package://other/fore.stl', "mesh package://other/fore.stl is in package 'other'", 'add to the robot "packages": {"other": "')
    yield urdf('package://meshes/fore.stl', 'package://meshes/gone.stl', "mesh package://meshes/gone.stl does not exist")
    yield urdf('package://meshes/fore.stl', 'file:///etc/hostname', "mesh file:///etc/hostname lies neither", 'add to the robot "packages": {"etc": "/etc"}')
    yield urdf('package://meshes/fore.stl', 'http://a/fore.stl', "mesh http://a/fore.stl is neither package:// nor file://")
    yield urdf('package://meshes/fore.stl', 'package://meshes/../cell.json', "leaves its folder")
    yield urdf(' filename="package://meshes/fore.stl"', '', "robot.urdf: link right_fore: mesh filename is missing")
    yield urdf('scale="1 1 1"', 'scale="1 0 1"', "robot.urdf: link right_fore: mesh scale holds a 0")
    yield urdf('name="left_bend" type="revolute"', 'name="left_bend" type="hinge"', "robot.urdf: joint left_bend: joint type 'hinge' is not known")
    yield urdf('name="left_bend" type="revolute"', 'name="left_bend"', "robot.urdf: joint left_bend: joint type is missing")
    yield urdf('name="left_bend" type="revolute"', 'name="left_bend" type="floating"', "group left_arm: joint left_bend is floating or planar, which no arm can hold", hides=True)
    yield urdf('axis xyz="0 0 1.0"', 'axis xyz="0 0 0"', "robot.urdf: joint left_bend: axis xyz '0 0 0' has no direction")
    yield urdf('<axis xyz="0 0.0 1"/>', '<axis/>', "robot.urdf: joint right_bend: axis xyz is missing")
    yield urdf('<axis xyz="0 0.0 1"/>', '<axis xyz="0 0.0 1"/><axis xyz="1 0 0"/>', "robot.urdf: joint right_bend: more than one <axis>")
    yield urdf(' velocity="2.3"', '', 'add to the arm "limits": {"right_bend": {"velocity_rad_s": 1}}')
    yield urdf('velocity="2.3"', 'velocity="0"', 'add to the arm "limits": {"right_bend": {"velocity_rad_s": 1}}')
    yield urdf(' velocity="2.1"', '', 'add to the arm\'s "limits" "left_bend": {"velocity_rad_s": 1}')
    yield urdf(' lower="-2.7" upper="2.7"', '', '"left_bend": {"lower_rad": -1, "upper_rad": 1}')
    yield urdf('lower="-2.7"', 'lower="2.75"', "robot.urdf: joint left_bend: limit lower 2.75 is above upper 2.7", '"left_bend": {"lower_rad": -1, "upper_rad": 1}')
    yield urdf('velocity="2.1"', 'velocity="-2.1"', "robot.urdf: joint left_bend: limit velocity is -2.1", '"left_bend": {"velocity_rad_s": 1}')
    yield urdf('mimic joint="left_grip"', 'mimic joint="grip"', "robot.urdf: joint left_mirror: mimic joint grip does not exist")
    yield urdf('mimic joint="left_grip"', 'mimic joint="left_mirror"', "robot.urdf: joint left_mirror: the joint mimics itself")
    yield urdf('mimic joint="left_grip"', 'mimic', "robot.urdf: joint left_mirror: mimic joint is missing")
    tree = {"subject": "tree"}
    yield urdf('<link name="left_thumb"/>', '<link name="left_thumb"/><link name="left_thumb"/>', "robot.urdf: link left_thumb: more than one link has this name")
    yield urdf('joint name="left_mirror"', 'joint name="left_grip"', "robot.urdf: joint left_grip: more than one joint has this name", **tree)
    yield urdf('<link name="left_finger"/>', '<link/><link name="left_finger"/>', "robot.urdf: link: link name is missing")
    yield urdf('<joint name="left_mirror"', '<joint', "robot.urdf: joint: joint name is missing", **tree)
    yield urdf('<child link="left_finger"/>', '<child link="finger"/>', "robot.urdf: joint left_grip: child link finger does not exist", **tree)
    yield urdf('<parent link="left_upper"/>', '<parent link="upper"/>', "robot.urdf: joint left_bend: parent link upper does not exist", **tree)
    yield urdf('<child link="left_finger"/>', '', "robot.urdf: joint left_grip: <child> is missing", **tree)
    yield urdf('<child link="left_finger"/>', '<child link="left_thumb"/>', "left_thumb already hangs on joint left_grip", **tree)
    yield urdf('<link name="left_thumb"/>', '<link name="left_thumb"/><link name="stray"/>', "robot.urdf: robot: more than one root link: base (line 3), stray (line 7); hang all but one on a <joint>", **tree)
    yield urdf('<parent link="left_upper"/>', '<parent link="left_fore"/>', "robot.urdf: robot: links hang in a loop and not below a root: left_finger (line 6), left_fore (line 5), left_thumb (line 7)", **tree)
    yield urdf('<robot name="pair">', '<robot>', "robot.urdf: robot: robot name is missing")
    whole = {"hides": True}
    yield urdf('</robot>\n', '', "robot.urdf:", "the XML is malformed", **whole)
    yield urdf('<link name="base">', '<link name="base>', "robot.urdf:", "the XML is malformed", **whole)
    yield urdf('<?xml version="1.0"?>', '<!DOCTYPE robot>', "robot.urdf:1: a DOCTYPE or entity declaration is not allowed", **whole)
    yield urdf('<robot name="pair">', '<robot name="pair"><xacro:property name="a" value="1"/>', "robot.urdf:2: the file is xacro", **whole)
    yield urdf('<link name="base">', '<link name="base\xff">', "robot.urdf:3: the byte 0xff is not UTF-8", **whole)
    yield urdf(URDF, '', "robot.urdf:", "the XML is malformed", **whole)
    yield urdf(URDF, '<sdf/>', "robot.urdf:1: the root element is <sdf>, not <robot>", **whole)
    yield urdf(URDF[600:], '', "robot.urdf:", "the XML is malformed", **whole)


def of_srdf():
    yield srdf('<joint name="left_pan"/><joint name="left_bend"/>', '<joint name="pan"/><joint name="bend"/>', "group left_arm: joint pan is not in robot.urdf", "arm left: group 'left_arm' holds no movable joint; groups that do:", subject="left")
    yield srdf('<joint name="left_bend"/>', '<joint name="bend"/>', "joint bend is not in robot.urdf; the group is without it", "arm left: home has 2 values, the group has 1 joints; give one for each of left_pan", subject="left")
    yield srdf('tip_link="right_fore"', 'tip_link="fore"', "chain tip_link fore is not in robot.urdf", "arm right: group 'right_arm' holds no movable joint", subject="right")
    yield srdf(' tip_link="right_fore"', '', "robot.srdf: group right_arm: chain tip_link is missing", subject="right")
    yield srdf('base_link="base"', 'base_link="left_upper"', "tip_link right_fore is not below base_link left_upper", subject="right")
    yield srdf('group name="left_arm"', 'group name="lefty"', "arm left: group 'left_arm' is not in robot.srdf", "groups that do: lefty", subject="left")
    yield srdf('group name="left_arm"', 'group name="right_arm"', "robot.srdf: group right_arm: more than one group has this name", hides=True)
    yield srdf('<joint name="left_bend"/>', '<joint/>', "robot.srdf: group left_arm: joint name is missing", subject="left")
    yield srdf('<group name="left_arm">', '<group name="left_arm"><group name="left_arm"/>', "robot.srdf: group left_arm: group left_arm holds this group too: a cycle", subject="left")
    yield srdf('state name="ready"', 'state name="steady"', "arm right: home 'ready' is no state of group 'right_arm' in robot.srdf; its states: steady", subject="right")
    yield srdf('value="1.2"', 'value="2.9"', "group_state ready of right_arm: joint right_pan is at 2.9, outside [-2.5, 2.5]", subject="right")
    yield srdf('value="1.2"', 'value="up"', "joint value is 'up', not a finite number", subject="right")
    yield srdf('<joint name="right_bend" value="-0.4"/>', '', "group_state ready of right_arm: joint right_bend has no value", subject="right")
    yield srdf('<joint name="right_bend" value="-0.4"/>', '<joint name="right_pan" value="-0.4"/>', "joint right_pan has more than one value", subject="right")
    whole = {"hides": True}
    yield srdf('</robot>\n', '', "robot.srdf:", "the XML is malformed", **whole)
    yield srdf('<robot name="pair">', '<srdf name="pair">', "robot.srdf:", "the XML is malformed", **whole)
    yield srdf(SRDF, '', "robot.srdf:", "the XML is malformed", **whole)
    yield srdf(SRDF[400:], '', "robot.srdf:", "the XML is malformed", **whole)
    yield srdf('<?xml version="1.0"?>', '<!DOCTYPE a [<!ENTITY b "c">]>', "robot.srdf:", **whole)


def of_limits():
    for old, new, key in ((": 1.9", ": {}", "max_velocity"), (": 4.5", ": {}", "max_acceleration"),
                          (": 900", ": {}", "max_jerk"), ("min_position: -2.5", "min_position: {}", "min_position")):
        for bad in ("fast", ".nan", "[1]", "''"):
            line = LIMITS[:LIMITS.index(old)].count("\n") + 1
            shown = {"[1]": "no single value", "''": ""}.get(bad, bad)
            yield limits(old, new.format(bad), f": {key} is '{shown}', not a finite number")
    yield limits(": 1.9", ": 0", ": max_velocity is 0, it must be greater than 0")
    yield limits(": 900", ": -900", "max_jerk is -900, it must be greater than 0")
    yield limits("    max_acceleration: 4.5\n", "", "joint left_bend: max_acceleration is missing, and has_acceleration_limits is true")
    yield limits("has_velocity_limits: true", "has_velocity_limits: often", "has_velocity_limits is 'often', not true or false")
    yield limits("has_jerk_limits: true", "has_jerk_limits: true\n    has_jerk_limits: true", "has_jerk_limits stands there twice")
    yield limits("min_position: -2.5", "min_position: 2.6", "min_position 2.6 is above max_position 2.5")
    yield limits("  left_bend:\n", "  left_pan:\n", "joint left_pan: more than one joint has this name", subject="left_bend")
    yield limits(":\n    has_jerk_limits: true\n    max_jerk: 900", ": 900", "joint right_bend: limits are expected, as keys and values")
    whole = {"hides": True}
    yield limits("joint_limits:\n", "limits:\n", "joint_limits.yaml: there is no joint_limits", **whole)
    yield limits("  left_pan:\n", "  left_pan: [\n", "joint_limits.yaml:", "the YAML is malformed", **whole)
    yield limits("  left_pan:\n", "\tleft_pan:\n", "joint_limits.yaml:", "the YAML is malformed", **whole)
    yield limits(LIMITS, "", "joint_limits.yaml: there is no joint_limits", **whole)
    yield limits(LIMITS, "- 1\n- 2\n", "joint_limits.yaml: there is no joint_limits", **whole)


def of_cell():
    robot, left, right = "/robots/0", "/robots/0/arms/0", "/robots/0/arms/1"
    yield cell('"urdf": "robot.urdf"', '"urdf": "gone.urdf"', f"{robot}/urdf", "gone.urdf: there is no such file", hides=True)
    yield cell('"srdf": "robot.srdf"', '"srdf": "gone.srdf"', f"{robot}/srdf", "gone.srdf: there is no such file", hides=True)
    yield cell('"joint_limits.yaml"', '"gone.yaml"', f"{robot}/joint_limits", "gone.yaml: there is no such file", hides=True)
    yield cell('"robot.srdf"', '"meshes"', f"{robot}/srdf", "it is not a regular file", hides=True)
    yield cell('"group": "left_arm"', '"group": "arm"', f"{left}/group", "group 'arm' is not in robot.srdf", "groups that do: left_arm, right_arm", subject="left")
    yield cell('[2.0, 0.4]', '[2.0]', f"{left}/home", "home has 1 values, the group has 2 joints; give one for each of left_pan, left_bend", subject="left")
    yield cell('[2.0, 0.4]', '[2.9, 0.4]', f"{left}/home/0", "home of r_left_pan is 2.9, outside [-2.8, 2.8] rad", subject="left")
    yield cell('"home": "ready"', '"home": "there"', f"{right}/home", "home 'there' is no state of group 'right_arm' in robot.srdf; its states: ready")
    yield cell('{"left_pan"', '{"pan"', f"{left}/limits/pan", "arm left has no joint pan to limit", subject="left")
    yield cell('"velocity_rad_s": 1.8', '"velocity_rad_s": 2.8', f"{left}/limits/left_pan/velocity_rad_s", "velocity_rad_s is 2.8, wider than the URDF's 2", subject="left")
    yield cell('"velocity_rad_s": 1.8', '"lower_rad": -3', "lower_rad is -3, wider than the URDF's -2.8", subject="left")
    yield cell('"left_grip": 0.01', '"left_grip": 0.5', f"{robot}/fixed/left_grip", "joint left_grip is held at 0.5, outside [0, 0.04]")
    yield cell('"left_grip": 0.01', '"grip": 0.01', f"{robot}/fixed/grip", "fixed joint grip is not in robot.urdf")
    yield cell('"left_grip": 0.01', '"left_mirror": 0.01', "joint left_mirror follows joint left_grip: hold that one", subject="mirror")
    yield cell('"name": "right"', '"name": "left"', f"{right}/name", "the name left of an arm is taken")
    yield cell('{"name": "block"', '{"name": "r_base"', "/objects/0/name", "the name r_base of an object is a link's name too", subject="block")
    yield cell('["r_base", "block"]', '["base", "block"]', "/allowed_collisions/0/0", "there is no link or object base", subject="block")
    yield cell('"stop_clearance_m": 0.01', '"stop_clearance_m": 0.03', "/monitor/stop_clearance_m", "stop_clearance_m is 0.03, it must be at most clearance_m")
    yield cell('{"meshes": "meshes"}', '{"mesh": "meshes"}', "mesh package://meshes/fore.stl is in package 'meshes'", 'add to the robot "packages": {"meshes": "',
               subject="packages")  # not told where the URDF's mesh is no longer in the package
    # What the reader of the cell file itself says: the description is not complete then.
    for old, new, *told in (
            ('"home": "ready"', '"home": 3', f"{right}/home"),
            ('"left_grip": 0.01', '"left_grip": "low"', f"{robot}/fixed/left_grip"),
            ('"box": [0.1, 0.2, 0.3]', '"box": [0.1, 0.2]', "/objects/0/box"),
            ('"box": [0.1, 0.2, 0.3]', '"box": [0.1, 0.2, -0.3]', "/objects/0/box"),
            ('"clearance_m": 0.02', '"clearence_m": 0.02', "/clearence_m"),
            ('"time_step_s": 0.05', '"time_step_s": "fast"', "/checking/time_step_s"),
            ('"velocity_rad_s": 1.8', '"velocity_rad_s": -1.8', f"{left}/limits/left_pan/velocity_rad_s"),
            ('"policy": "coordinated"', '"policy": 7', "/scheduling/policy"),
            ('"rate_hz": 100', '"rate_hz": 0', "/monitor/rate_hz"),
            ('"xyz": [0, 0, 1]', '"xyz": [0, 0, null]', f"{robot}/base/xyz")):
        yield cell(old, new, *told, subject="shape")
    yield cell('"urdf": "robot.urdf", ', '', f'{robot}/urdf: "urdf" is missing', hides=True)
    yield cell('"arms": [', '"arms": 5, "x": [', f"{robot}/arms: expected an array", f'{robot}/x: unknown field "x"', hides=True)
    yield cell('"policy": "coordinated"', '"policy": "hasty"', "hasty", hides=True)
    yield cell(CELL[300:], '', "cell.json:", hides=True)
    yield cell(CELL, '[]', "cell.json:", hides=True)


def of_meshes():
    sound = FORE.decode("latin-1")
    for bad in (sound[:200], "", "solid a\nendsolid a\n", sound[:84], sound[:96] + "\x00\x00\xc0\x7f" + sound[100:],
                sound[:80] + "\xff\xff\xff\x7f" + sound[84:]):
        yield Damage("meshes/fore.stl", sound, bad, ("robot.urdf: link right_fore", "fore.stl"), hides=True)


def all_damages():
    return [*of_urdf(), *of_srdf(), *of_limits(), *of_cell(), *of_meshes()]
