#pragma once

#include <Eigen/Geometry>

#include "core/planning/kdl_chain.h"

namespace armloom {

// Moves the arm's joints from `q` toward the pose X_WL (in the world) of the chain's link: damped
// steps within the joints' limits. The result may miss the pose. Internal to core/planning.
[[nodiscard]] Eigen::VectorXd descend(const Cell& cell, const Arm& arm, const KdlChain& chain,
                                      const Eigen::Isometry3d& X_WL, Eigen::VectorXd q);

}  // namespace armloom
