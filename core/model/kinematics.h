#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/model/cell.h"

namespace armloom {

// Pose of each link in the world, indexed by LinkId.
using LinkPoses = std::vector<Eigen::Isometry3d>;

// Computes the poses of all links of the cell in configuration q. Throws std::invalid_argument if q
// does not have one entry per joint of the cell. The caller owns X_WL, which is resized and
// overwritten; calls after the first do not reallocate it. Thread-safe if each thread has its own
// X_WL.
void forward_kinematics(const Cell& cell, const Configuration& q, LinkPoses& X_WL);

}  // namespace armloom
