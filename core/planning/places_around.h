#pragma once

#include <Eigen/Core>

#include "core/model/cell.h"

namespace armloom {

// Returns the i-th (from 1) of kPlacesLookedAt candidate positions around `centre`, clamped to the
// limits. Candidates are points of the Halton sequence in a box that grows with i. The largest box
// extends from the center by the range of each joint, or by pi for a joint without limits (rad or
// m).
inline constexpr int kPlacesLookedAt = 256;
[[nodiscard]] Eigen::VectorXd place_around(const Cell& cell, const Arm& arm,
                                           const Eigen::VectorXd& centre, int i);
// Clamps each joint to its limits.
[[nodiscard]] Eigen::VectorXd within_limits(const Cell& cell, const Arm& arm, Eigen::VectorXd q);

}  // namespace armloom
