#include <algorithm>
#include <set>

#include "core/model/cell/robot_build.h"

namespace armloom {
namespace {

using JointsOfTheCell = std::set<JointId>;

// Returns, for each tree index, the joints on which the link's pose depends: its own joint, and all
// joints between it and the root.
std::vector<JointsOfTheCell> joints_above(const RobotBuild& robot, const Cell& cell) {
  std::vector<JointsOfTheCell> above;
  for (std::size_t i = 0; i < robot.tree.links.size(); ++i) {
    const auto parent = robot.tree.links[i].parent;
    above.push_back(parent ? above[*parent] : JointsOfTheCell{});
    if (const auto driver = cell.link(robot.links[i]).driver) above.back().insert(*driver);
  }
  return above;
}

// Returns the joints on which the poses of the arm's links depend: its own joints with its gripper,
// and all joints between them and the root.
JointsOfTheCell joints_that_place(const Arm& arm, ArmId id, const Cell& cell,
                                  const RobotBuild& robot,
                                  const std::vector<JointsOfTheCell>& above) {
  JointsOfTheCell joints(arm.joints.begin(), arm.joints.end());
  for (std::size_t i = 0; i < above.size(); ++i) {
    const auto driver = cell.link(robot.links[i]).driver;
    const bool moved = driver && (joints.contains(*driver) || cell.joint(*driver).arm == id);
    if (moved) joints.insert(above[i].begin(), above[i].end());
  }
  return joints;
}

std::string plain_name(const RobotBuild& robot, const Cell& cell, JointId joint) {
  return cell.joint(joint).name.substr(robot.description->prefix.size());
}

// Returns the cell file line that fixes each joint at its permitted position nearest to 0.
std::string line_to_hold(const RobotBuild& robot, const Cell& cell,
                         const std::vector<JointId>& joints) {
  std::string members;
  for (const JointId id : joints) {
    const auto& limits =
        robot.tree.links[robot.tree.by_joint.at(plain_name(robot, cell, id))].joint.limits;
    double value = 0.0;
    if (limits.lower) value = std::max(value, *limits.lower);
    if (limits.upper) value = std::min(value, *limits.upper);
    members +=
        (members.empty() ? "\"" : ", \"") + plain_name(robot, cell, id) + "\": " + text_of(value);
  }
  return robot.description->fixed.empty() ? "add to the robot \"fixed\": {" + members + "}"
                                          : "add to the robot's \"fixed\" " + members;
}

}  // namespace

void refuse_shared_joints(RobotBuild& robot, const Cell& cell, Diagnostics& diagnostics) {
  if (robot.tree.patched) return;  // joints may be misplaced
  const auto above = joints_above(robot, cell);
  std::vector<JointsOfTheCell> places;
  for (const ArmBuild& arm : robot.arms)
    places.push_back(joints_that_place(cell.arm(arm.id), arm.id, cell, robot, above));

  std::set<JointId> shared;
  std::string arms;
  for (std::size_t a = 0; a < places.size(); ++a) {
    bool shares = false;
    for (std::size_t b = 0; b < places.size(); ++b) {
      if (a == b) continue;
      for (const JointId joint : places[a]) {
        if (!places[b].contains(joint)) continue;
        shared.insert(joint);
        shares = true;
      }
    }
    if (shares) arms += (arms.empty() ? "" : ", ") + robot.arms[a].description->name;
  }
  if (shared.empty()) return;

  robot.shared = shared;
  const std::vector<JointId> joints(shared.begin(), shared.end());
  std::string names;
  for (const JointId joint : joints)
    names += (names.empty() ? "" : ", ") + plain_name(robot, cell, joint);
  const bool leaves_arms = std::all_of(robot.arms.begin(), robot.arms.end(), [&](const auto& arm) {
    const auto& own = cell.arm(arm.id).joints;
    return !std::all_of(own.begin(), own.end(), [&](JointId j) { return shared.contains(j); });
  });
  const std::string remedy = leaves_arms
                                 ? "hold the shared joints (" + line_to_hold(robot, cell, joints) +
                                       ") or make them one arm"
                                 : "one of them moves the other, so make them one arm";
  diagnostics.in_cell("shared-joint", robot.pointer + "/arms",
                      "robot " + robot.description->name + ": arms " + arms +
                          " share the movable joints " + names + ", so each moves the other; " +
                          remedy,
                      names);
}

}  // namespace armloom
