#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/model/cell.h"

namespace armloom {

// Pose of each link in the world, indexed by LinkId.
using LinkPoses = std::vector<Eigen::Isometry3d>;

// Computes the forward kinematics of the whole cell. q has one entry per joint of the cell; throws
// std::invalid_argument otherwise. X_WL is caller-owned scratch: resized, overwritten, and not
// reallocated from the second call on. Thread-safe on distinct scratch.
void forward_kinematics(const Cell& cell, const Configuration& q, LinkPoses& X_WL);

}  // namespace armloom
