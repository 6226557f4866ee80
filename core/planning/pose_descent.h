#pragma once

#include <Eigen/Geometry>

#include "core/planning/kdl_chain.h"

namespace armloom {

// From the arm's joints at `q` downhill to where the chain's link is at X_WL, in the world: damped
// steps, each within the joints' limits. Where it ends need not be there. Inside of core/planning.
[[nodiscard]] Eigen::VectorXd descend(const Cell& cell, const Arm& arm, const KdlChain& chain,
                                      const Eigen::Isometry3d& X_WL, Eigen::VectorXd q);

}  // namespace armloom
