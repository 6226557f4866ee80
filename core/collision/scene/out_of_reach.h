#pragma once

#include <set>

#include "core/collision/scene/scene_bodies.h"

namespace armloom {

// Budgets of one proof, and of all proofs of a cell: comparisons of swept parts.
inline constexpr int kComparisonsPerPair = 4'000;
inline constexpr int kComparisonsPerCell = 2'000'000;

// Returns the claimed pairs (AllowedCollisions::claimed_pairs) that are proven to keep the cell's
// clearance_m at all joint positions within the limits, exceeded by up to
// checking.tracking_error_rad and execution.start_tolerance_rad. Never wrong, but omits a pair if
// the proof exceeds the budget or the capsules are too coarse. Deterministic. Precondition:
// `bodies` has all links.
[[nodiscard]] std::set<LinkPair> pairs_out_of_reach(const PlanningScene::Bodies& bodies);

}  // namespace armloom
