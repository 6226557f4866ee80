#include "core/model/kinematics.h"

#include <stdexcept>
#include <string>

namespace armloom {
namespace {

// Moves the pose X by the joint's motion to position `value` (rad or m): multiplies X by the motion
// from the right. Rotations use Rodrigues' formula, as in Eigen's AngleAxis.
void move(const Link& link, double value, Eigen::Isometry3d& X) {
  if (link.motion == JointKind::prismatic) {
    X.translation() += X.linear() * (link.axis * value);
  } else {
    X.linear() = (X.linear() * Eigen::AngleAxisd(value, link.axis).toRotationMatrix()).eval();
  }
}

}  // namespace

void forward_kinematics(const Cell& cell, const Configuration& q, LinkPoses& X_WL) {
  if (static_cast<std::size_t>(q.size()) != cell.joints.size()) {
    throw std::invalid_argument("forward_kinematics: q has " + std::to_string(q.size()) +
                                " entries, the cell has " + std::to_string(cell.joints.size()) +
                                " joints");
  }
  X_WL.resize(cell.links.size());
  for (std::size_t l = 0; l < cell.links.size(); ++l) {
    const Link& link = cell.links[l];
    Eigen::Isometry3d& X = X_WL[l];
    X = link.parent ? X_WL[link.parent->index()] * link.X_PJ : link.X_PJ;
    if (link.driver) {
      move(link, link.multiplier * q[static_cast<Eigen::Index>(link.driver->index())] + link.offset,
           X);
    }
  }
}

}  // namespace armloom
