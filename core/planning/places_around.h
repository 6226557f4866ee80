#pragma once

#include <Eigen/Core>

#include "core/model/cell.h"

namespace armloom {

// Joint positions around others, the i-th of kPlacesLookedAt (1 on): places of the Halton sequence
// in a box that grows with i up to the joints' ranges, or half a turn where a joint has none.
// Within the limits.
inline constexpr int kPlacesLookedAt = 256;
[[nodiscard]] Eigen::VectorXd place_around(const Cell& cell, const Arm& arm,
                                           const Eigen::VectorXd& centre, int i);
// Each joint at its nearest limit, where it is beyond.
[[nodiscard]] Eigen::VectorXd within_limits(const Cell& cell, const Arm& arm, Eigen::VectorXd q);

}  // namespace armloom
