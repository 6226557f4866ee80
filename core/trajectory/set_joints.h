#pragma once

#include <vector>

#include "core/model/cell.h"
#include "core/trajectory/trajectory.h"

namespace armloom {

// Sets these joints to `position` (in their order); others stay.
inline void set_joints(Configuration& q, const std::vector<JointId>& joints,
                       const Eigen::VectorXd& position) {
  for (std::size_t j = 0; j < joints.size(); ++j) {
    q[static_cast<Eigen::Index>(joints[j].index())] = position[static_cast<Eigen::Index>(j)];
  }
}
inline void set_joints(Configuration& q, const Trajectory& trajectory,
                       const Eigen::VectorXd& position) {
  set_joints(q, trajectory.joints(), position);
}

// Sets the arm's joints to their part of `position`, which is in the order of the motion's joints;
// joints outside the motion stay.
inline void set_joints_of(Configuration& q, const Cell& cell, ArmId arm, const Trajectory& motion,
                          const Eigen::VectorXd& position) {
  for (std::size_t j = 0; j < motion.joints().size(); ++j) {
    const JointId joint = motion.joints()[j];
    if (cell.joint(joint).arm != arm) continue;
    q[static_cast<Eigen::Index>(joint.index())] = position[static_cast<Eigen::Index>(j)];
  }
}
inline void follow_to_end(Configuration& q, const Cell& cell, ArmId arm, const Trajectory& motion) {
  set_joints_of(q, cell, arm, motion, motion.goal());
}

// Returns the joints that the arm's controller moves: Arm::joints, then Arm::gripper_joints.
[[nodiscard]] inline std::vector<JointId> joints_and_gripper(const Arm& arm) {
  std::vector<JointId> joints = arm.joints;
  joints.insert(joints.end(), arm.gripper_joints.begin(), arm.gripper_joints.end());
  return joints;
}

// Returns the positions of these joints, in their order.
[[nodiscard]] inline Eigen::VectorXd joints_of(const Configuration& q,
                                               const std::vector<JointId>& joints) {
  Eigen::VectorXd position(static_cast<Eigen::Index>(joints.size()));
  for (std::size_t j = 0; j < joints.size(); ++j) {
    position[static_cast<Eigen::Index>(j)] = q[static_cast<Eigen::Index>(joints[j].index())];
  }
  return position;
}

}  // namespace armloom
