#pragma once

#include <Eigen/Geometry>

#include "core/planning/kdl_chain.h"

namespace armloom {

// Moves the arm's joints from `q` in damped steps within their limits, so that the chain's link
// approaches the pose X_WL in the world. Returns the joint positions, which may miss the pose.
// Internal to core/planning.
[[nodiscard]] Eigen::VectorXd descend(const Cell& cell, const Arm& arm, const KdlChain& chain,
                                      const Eigen::Isometry3d& X_WL, Eigen::VectorXd q);

}  // namespace armloom
