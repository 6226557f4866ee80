#include "core/scheduler/yielding/ways_aside.h"

#include <algorithm>

#include "core/trajectory/joint_line.h"

namespace armloom {
namespace {

Eigen::VectorXd standing(const std::vector<JointId>& joints, const Configuration& rest) {
  Eigen::VectorXd q(static_cast<Eigen::Index>(joints.size()));
  for (std::size_t j = 0; j < joints.size(); ++j) {
    q[static_cast<Eigen::Index>(j)] = rest[static_cast<Eigen::Index>(joints[j].index())];
  }
  return q;
}

// Where the arm's joints are at the motion's start or goal; those that it does not move, as here.
Eigen::VectorXd end_of(const Trajectory& motion, const Eigen::VectorXd& end,
                       const std::vector<JointId>& joints, Eigen::VectorXd here) {
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const auto found = std::ranges::find(motion.joints(), joints[j]);
    if (found == motion.joints().end()) continue;
    here[static_cast<Eigen::Index>(j)] = end[found - motion.joints().begin()];
  }
  return here;
}

}  // namespace

std::vector<TrajectoryPtr> ways_aside(const Cell& cell, ArmId arm, const Configuration& rest,
                                      const TrajectoryPtr& came_by) {
  const double tolerance = cell.execution.start_tolerance_rad;
  const auto apart = [](const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    return (a - b).cwiseAbs().maxCoeff();
  };
  std::vector<TrajectoryPtr> ways;
  const Arm& description = cell.arm(arm);
  const Eigen::VectorXd here = standing(description.joints, rest);
  const auto add = [&](const Eigen::VectorXd& pose) {
    if (pose.size() != here.size() || apart(pose, here) <= tolerance) return;
    if (auto line = joint_line(cell, description.joints, here, pose)) ways.push_back(*line);
  };
  if (came_by && apart(came_by->goal(), standing(came_by->joints(), rest)) <= tolerance) {
    ways.push_back(retraced(*came_by));
  } else if (came_by) {
    add(end_of(*came_by, came_by->start(), description.joints, here));
    add(end_of(*came_by, came_by->goal(), description.joints, here));
  }
  add(description.home);
  for (const auto& [name, pose] : description.named_states) add(pose);
  return ways;
}

}  // namespace armloom
