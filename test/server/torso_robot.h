#pragma once

#include <string>

namespace armloom::test {

// A small robot as MoveIt users have them: two arms of three joints, each with a hand, on a lifting
// torso with a head. Its SRDF has groups of every kind.
inline std::string torso_urdf() {
  std::string text = R"(<robot name="torso_robot"><link name="base"/>)";
  struct Moves {  // joint type, axis and limits
    std::string type, axis, limit;
  };
  const auto joint = [&](const std::string& name, const std::string& parent, const std::string& xyz,
                         const Moves& moves) {
    text += "<link name=\"" + name + "_link\"><collision><origin xyz=\"0 0 0.1\"/><geometry>" +
            "<cylinder radius=\"0.03\" length=\"0.16\"/></geometry></collision></link>";
    text += "<joint name=\"" + name + "\" type=\"" + moves.type + "\"><parent link=\"" + parent +
            "\"/><child link=\"" + name + "_link\"/><origin xyz=\"" + xyz + "\"/><axis xyz=\"" +
            moves.axis + "\"/><limit " + moves.limit + " effort=\"1\" velocity=\"1\"/></joint>";
  };
  const std::string turn = R"(lower="-2.5" upper="2.5")";
  joint("torso_lift", "base", "0 0 0", {"prismatic", "0 0 1", R"(lower="0" upper="0.4")"});
  joint("head_pan", "torso_lift_link", "0 0 0.9", {"revolute", "0 0 1", turn});
  const Moves about_x{"revolute", "1 0 0", turn};
  for (const std::string side : {"left", "right"}) {
    const std::string y = side == "left" ? "0.4" : "-0.4";
    joint(side + "_1", "torso_lift_link", "0 " + y + " 0.5", about_x);
    joint(side + "_2", side + "_1_link", "0 0 0.25", about_x);
    joint(side + "_3", side + "_2_link", "0 0 0.25", about_x);
    joint(side + "_finger", side + "_3_link", "0 0 0.25",
          {"prismatic", "0 0 1", R"(lower="0" upper="0.02")"});
  }
  return text + "</robot>";
}

inline std::string torso_srdf() {
  return R"(<robot name="torso_robot">
  <group name="torso"><joint name="torso_lift"/></group>
  <group name="left_arm"><chain base_link="torso_lift_link" tip_link="left_3_link"/></group>
  <group name="right_arm"><joint name="right_1"/><joint name="right_2"/><joint name="right_3"/></group>
  <group name="left_wrist"><joint name="left_3"/></group>
  <group name="left_arm_and_torso"><chain base_link="base" tip_link="left_3_link"/></group>
  <group name="left_again"><chain base_link="torso_lift_link" tip_link="left_3_link"/></group>
  <group name="both_arms"><group name="left_arm"/><group name="right_arm"/></group>
  <group name="left_hand"><joint name="left_finger"/></group>
  <group name="right_hand"><joint name="right_finger"/></group>
  <group name="head"><joint name="head_pan"/></group>
  <group name="tool"><link name="base"/></group>
  <end_effector name="left_hand" parent_link="left_3_link" group="left_hand"/>
  <group_state name="crossed" group="left_arm">
    <joint name="left_1" value="2"/><joint name="left_2" value="0"/><joint name="left_3" value="0"/>
  </group_state>
  <group_state name="left_home" group="left_arm">
    <joint name="left_1" value="0"/><joint name="left_2" value="-0.5"/><joint name="left_3" value="0"/>
  </group_state>
  <group_state name="up" group="torso"><joint name="torso_lift" value="0.3"/></group_state>
  <group_state name="home" group="torso"><joint name="torso_lift" value="0.1"/></group_state>
</robot>)";
}

}  // namespace armloom::test
