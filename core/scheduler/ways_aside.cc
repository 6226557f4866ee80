#include "core/scheduler/ways_aside.h"

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

}  // namespace

std::vector<TrajectoryPtr> ways_aside(const Cell& cell, ArmId arm, const Configuration& rest,
                                      const TrajectoryPtr& came_by) {
  const double tolerance = cell.execution.start_tolerance_rad;
  std::vector<TrajectoryPtr> ways;
  if (came_by) {
    const Eigen::VectorXd here = standing(came_by->joints(), rest);
    if ((came_by->goal() - here).cwiseAbs().maxCoeff() <= tolerance) {
      ways.push_back(retraced(*came_by));
    }
  }
  const Arm& description = cell.arm(arm);
  const Eigen::VectorXd here = standing(description.joints, rest);
  const auto add = [&](const Eigen::VectorXd& pose) {
    if (pose.size() != here.size() || (pose - here).cwiseAbs().maxCoeff() <= tolerance) return;
    if (auto line = joint_line(cell, description.joints, here, pose)) ways.push_back(*line);
  };
  add(description.home);
  for (const auto& [name, pose] : description.named_states) add(pose);
  return ways;
}

}  // namespace armloom
