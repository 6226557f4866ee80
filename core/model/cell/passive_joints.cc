#include <algorithm>

#include "core/model/cell/robot_build.h"

namespace armloom {

void warn_of_passive_joints(const RobotBuild& robot, const Cell& cell, Diagnostics& diagnostics) {
  if (!robot.semantics) return;
  for (const auto& [index, place] : robot.semantics->passive) {
    for (const ArmBuild& build : robot.arms) {
      const bool in_group =
          std::find(build.group.begin(), build.group.end(), index) != build.group.end();
      if (!in_group || !robot.joints[index]) continue;  // or fixed
      const std::string& joint = robot.tree.links[index].joint.name;
      diagnostics.warn(
          {ProblemKind::invalid, "passive-joint", place,
           place + ": joint " + joint + " is passive (the robot has no motor for it), " +
               "but in the group of arm " + cell.arm(build.id).name +
               ": it is checked as if jobs moved it, which the robot cannot do; take it out of "
               "group " +
               cell.arm(build.id).group + ", or hold it with \"fixed\"",
           joint});
    }
  }
}

}  // namespace armloom
