#include <algorithm>
#include <map>
#include <set>

#include "core/model/cell/robot_build.h"

namespace armloom {
namespace {

// Returns the joints that belong to no arm and on which the link's pose depends.
std::set<JointId> standing_above(const Cell& cell, LinkId id) {
  std::set<JointId> joints;
  for (std::optional<LinkId> link = id; link; link = cell.link(*link).parent) {
    const auto& driver = cell.link(*link).driver;
    if (driver && !cell.joint(*driver).arm) joints.insert(*driver);
  }
  return joints;
}

class StandingJoints {
 public:
  StandingJoints(const RobotBuild& robot, const Cell& cell, Diagnostics& diagnostics)
      : robot_(robot), cell_(cell), diagnostics_(diagnostics) {}

  void tell() {
    find_above_arms();
    std::string names;
    std::string line;
    for (const auto& [joint, arms] : arms_above_) {
      if (arms.size() > 1) continue;  // reported by refuse_shared_joints
      list(joint, names, line, std::string::npos);
    }
    if (!names.empty()) {
      diagnostics_.in_cell("stationary-joint", robot_.pointer,
                           "robot " + robot_.description->name + ": " + names +
                               " would move an arm but is in no arm's group, so its position must "
                               "be given: " +
                               how_to_hold(line),
                           names);
    }
    warn_of_others();
    warn_of_gaps();
  }

 private:
  void find_above_arms() {
    for (const ArmBuild& build : robot_.arms) {
      for (const LinkId link : cell_.arm(build.id).links) {
        for (const JointId joint : standing_above(cell_, link)) arms_above_[joint].insert(build.id);
      }
    }
  }

  // Warns of joints that move shapes but no arm, such as the joint of a sliding table.
  void warn_of_others() {
    std::set<JointId> others;
    for (const LinkId link : robot_.links) {
      if (cell_.link(link).shapes.empty()) continue;
      for (const JointId joint : standing_above(cell_, link)) {
        if (!arms_above_.contains(joint)) others.insert(joint);
      }
    }
    std::string names;
    std::string line;
    for (const JointId joint : others) list(joint, names, line, kLongest);
    if (names.empty()) return;
    diagnostics_.warn(
        {ProblemKind::invalid, "stationary-joint", robot_.pointer,
         "robot " + robot_.description->name + ": " + names +
             " is in no arm's group, so the links that it moves are checked only at its position 0 "
             "(or at the limit next to 0); if it is elsewhere, " +
             how_to_hold(line),
         names});
  }

  // Warns of a gripper joint between joints of an arm's group: its position changes the poses of
  // the arm's links.
  void warn_of_gaps() {
    for (const ArmBuild& build : robot_.arms) {
      std::set<std::string> skipped;
      for (const std::size_t index : build.group) {
        for (auto above = robot_.tree.links[index].parent; above;
             above = robot_.tree.links[*above].parent) {
          const auto& joint = robot_.joints[*above];
          const bool in_group = std::ranges::find(build.group, *above) != build.group.end();
          if (joint && !in_group && cell_.joint(*joint).arm == build.id)
            skipped.insert(robot_.tree.links[*above].joint.name);
        }
      }
      for (const std::string& name : skipped) {
        diagnostics_.warn(
            {ProblemKind::invalid, "group-with-gap", build.pointer + "/group",
             "arm " + build.description->name + ": joint " + name +
                 " is between joints of group '" + build.description->group +
                 "' but not in it: it is treated as a gripper joint, and jobs that do not "
                 "name it leave it where it is; add it to the group, or hold it with \"fixed\"",
             name});
      }
    }
  }

  void list(JointId id, std::string& names, std::string& line, std::size_t longest) const {
    const std::string name = cell_.joint(id).name.substr(robot_.description->prefix.size());
    if (names.size() > longest) {
      if (!names.ends_with("...")) names += ", ...";
      return;
    }
    names += (names.empty() ? "joint " : ", ") + name;
    line += (line.empty() ? "\"" : ", \"") + name + "\": 0";
  }

  std::string how_to_hold(const std::string& line) const {
    return robot_.description->fixed.empty()
               ? "add to the robot \"fixed\": {" + line + "}, with its value"
               : "add to the robot's \"fixed\" " + line + ", with its value";
  }

  static constexpr std::size_t kLongest = 200;

  const RobotBuild& robot_;
  const Cell& cell_;
  Diagnostics& diagnostics_;
  std::map<JointId, std::set<ArmId>> arms_above_;
};

}  // namespace

void tell_standing_joints(const RobotBuild& robot, const Cell& cell, Diagnostics& diagnostics) {
  if (robot.tree.patched) return;  // joints may be misplaced
  StandingJoints(robot, cell, diagnostics).tell();
}

}  // namespace armloom
