#pragma once

#include <string>

namespace armloom::test {

// Two arms on one body, as YuMi has them. Link 7 of each arm turns about the same axis as link 5, 2
// mm above it in every pose. The SRDF has a named state of the group of both arms only.
inline std::string close_wrists_urdf() {
  std::string text = R"(<robot name="twin"><link name="body"/>)";
  for (const std::string side : {"l", "r"}) {
    std::string parent = "body";
    const auto add = [&](const std::string& number, const std::string& xyz,
                         const std::string& radius, const std::string& length,
                         const std::string& middle) {
      const std::string link = "link_" + number + "_" + side;
      text += "<link name=\"" + link + "\"><collision><origin xyz=\"0 0 " + middle +
              "\"/><geometry><cylinder radius=\"" + radius + "\" length=\"" + length +
              "\"/></geometry></collision></link><joint name=\"joint_" + number + "_" + side +
              "\" type=\"revolute\"><parent link=\"" + parent + "\"/><child link=\"" + link +
              "\"/><origin xyz=\"" + xyz + "\"/><axis xyz=\"0 0 1\"/>" +
              R"(<limit lower="-2" upper="2" effort="1" velocity="1"/></joint>)";
      parent = link;
    };
    add("5", side == "l" ? "0 0.5 0" : "0 -0.5 0", "0.03", "0.1", "0.05");
    add("6", "0 0 0.1", "0.01", "0.002", "0.001");
    add("7", "0 0 0.002", "0.03", "0.1", "0.05");
  }
  return text + "</robot>";
}

// `more`: additional elements.
inline std::string close_wrists_srdf(const std::string& more = "") {
  std::string text = R"(<robot name="twin">
  <group name="left_arm"><chain base_link="body" tip_link="link_7_l"/></group>
  <group name="right_arm"><chain base_link="body" tip_link="link_7_r"/></group>
  <group name="both_arms"><group name="left_arm"/><group name="right_arm"/></group>
  <group_state name="home" group="both_arms">)";
  for (const std::string side : {"l", "r"})
    for (const std::string number : {"5", "6", "7"})
      text += "<joint name=\"joint_" + number + "_" + side + "\" value=\"0." + number + "\"/>";
  text += "</group_state>\n";
  for (const std::string side : {"l", "r"})
    for (const std::string number : {"5", "6"})
      text += "<disable_collisions link1=\"link_" + number + "_" + side + "\" link2=\"link_" +
              (number == "5" ? "6" : "7") + "_" + side + "\" reason=\"Adjacent\"/>\n";
  return text + more + "</robot>";
}

}  // namespace armloom::test
