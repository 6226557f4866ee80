#pragma once

#include <string>

namespace armloom::test {

// Returns the URDF of `arms` arms named arm0, arm1, ..., 0.6 m apart along x. Each has two 0.4 m
// links that turn about z, 0.3 m above a common bar. Two posts are fixed to the bar: `post` within
// reach of arm0's second link, `far_post` out of reach.
inline std::string arm_row_urdf(int arms) {
  const auto text = [](double number) { return std::to_string(number); };
  const auto box = [&](double x, double y, double z) {
    return "<geometry><box size=\"" + text(x) + " " + text(y) + " " + text(z) + "\"/></geometry>";
  };
  std::string urdf = "<robot name=\"row\"><link name=\"bar\"><collision><origin xyz=\"" +
                     text(0.3 * (arms - 1)) + " 0 0\"/>" + box(0.6 * arms, 0.1, 0.1) +
                     "</collision></link>";
  const auto post = [&](const std::string& name, double x, double y) {
    urdf += "<link name=\"" + name + "\"><collision>" + box(0.06, 0.06, 0.8) +
            "</collision></link><joint name=\"" + name + "_foot\" type=\"fixed\"><parent " +
            "link=\"bar\"/><child link=\"" + name + "\"/><origin xyz=\"" + text(x) + " " + text(y) +
            " 0.3\"/></joint>";
  };
  post("post", -0.6, 0.0);
  post("far_post", 0.0, 1.0);
  const auto link = [&](const std::string& name, const std::string& parent,
                        const std::string& xyz) {
    urdf += "<link name=\"" + name + "_link\"><collision><origin xyz=\"0.2 0 0\" rpy=\"0 " +
            "1.5707963267948966 0\"/><geometry><cylinder radius=\"0.03\" length=\"0.4\"/>" +
            "</geometry></collision></link><joint name=\"" + name +
            "\" type=\"revolute\"><parent " + "link=\"" + parent + "\"/><child link=\"" + name +
            "_link\"/><origin xyz=\"" + xyz +
            "\"/><axis xyz=\"0 0 1\"/><limit lower=\"-2.9\" upper=\"2.9\" effort=\"1\" " +
            "velocity=\"2\"/></joint>";
  };
  for (int i = 0; i < arms; ++i) {
    const std::string arm = "arm" + std::to_string(i);
    link(arm + "_1", "bar", text(0.6 * i) + " 0 0.3");
    link(arm + "_2", arm + "_1_link", "0.4 0 0");
  }
  return urdf + "</robot>";
}

// Returns an SRDF as the MoveIt Setup Assistant writes it without sampling collisions. It disables
// all pairs of links of different arms, and the pairs of arm0's links with the posts. There is one
// pair per line, from line 2 on.
inline std::string arm_row_srdf(int arms) {
  std::string srdf = "<robot name=\"row\">\n";
  const auto never = [&](const std::string& a, const std::string& b, const std::string& reason) {
    srdf +=
        "<disable_collisions link1=\"" + a + "\" link2=\"" + b + "\" reason=\"" + reason + "\"/>\n";
  };
  const auto link = [](int arm, int number) {
    return "arm" + std::to_string(arm) + "_" + std::to_string(number) + "_link";
  };
  for (int a = 0; a < arms; ++a) {
    for (int b = a + 1; b < arms; ++b) {
      for (const int x : {1, 2}) {
        for (const int y : {1, 2}) never(link(a, x), link(b, y), "Never");
      }
    }
  }
  for (const char* post : {"post", "far_post"}) {
    for (const int x : {1, 2}) never(link(0, x), post, "Never");
  }
  for (int a = 0; a < arms; ++a) {
    const std::string name = "arm" + std::to_string(a);
    never(link(a, 1), link(a, 2), "Adjacent");
    srdf += "<group name=\"" + name + "\"><joint name=\"" + name + "_1\"/><joint name=\"" + name +
            "_2\"/></group>\n";
  }
  return srdf + "</robot>";
}

}  // namespace armloom::test
