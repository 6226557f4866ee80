#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/model/cell.h"
#include "core/trajectory/trajectory.h"

namespace armloom {

// A joint that is not at the position where a motion begins (rad, m).
struct JointElsewhere {
  std::size_t place;  // in the motion's joints
  JointId joint;
  double begins, stands;
};

// Returns the joints whose positions `begins` (in the order of `joints`) and `stands` (of the whole
// cell) differ by more than execution.start_tolerance_rad. With `arm`, only joints of that arm.
[[nodiscard]] inline std::vector<JointElsewhere> joints_elsewhere(
    const Cell& cell, const std::vector<JointId>& joints, const Eigen::VectorXd& begins,
    const Configuration& stands, std::optional<ArmId> arm = {}) {
  std::vector<JointElsewhere> elsewhere;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (arm && cell.joint(joints[j]).arm != *arm) continue;
    const JointElsewhere one{j, joints[j], begins[static_cast<Eigen::Index>(j)],
                             stands[static_cast<Eigen::Index>(joints[j].index())]};
    const bool differs = std::abs(one.begins - one.stands) > cell.execution.start_tolerance_rad;
    if (differs) elsewhere.push_back(one);
  }
  return elsewhere;
}
[[nodiscard]] inline std::vector<JointElsewhere> joints_elsewhere(const Cell& cell,
                                                                  const Trajectory& motion,
                                                                  const Configuration& stands,
                                                                  std::optional<ArmId> arm = {}) {
  return joints_elsewhere(cell, motion.joints(), motion.start(), stands, arm);
}

}  // namespace armloom
