#pragma once

#include <Eigen/Core>

#include "core/model/cell.h"

namespace armloom {

// Returns the i-th (from 1) of kPlacesLookedAt joint positions around others, within the limits:
// points of the Halton sequence in a box that grows with i up to the joints' ranges, or half a turn
// for a joint without.
inline constexpr int kPlacesLookedAt = 256;
[[nodiscard]] Eigen::VectorXd place_around(const Cell& cell, const Arm& arm,
                                           const Eigen::VectorXd& centre, int i);
// Clamps each joint to its limits.
[[nodiscard]] Eigen::VectorXd within_limits(const Cell& cell, const Arm& arm, Eigen::VectorXd q);

}  // namespace armloom
