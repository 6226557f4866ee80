#pragma once

#include <set>

#include "core/collision/scene/scene_bodies.h"

namespace armloom {

// Budgets of one proof, and of all proofs of a cell: comparisons of two swept parts.
inline constexpr int kComparisonsPerPair = 4'000;
inline constexpr int kComparisonsPerCell = 2'000'000;

// Returns the claimed pairs (AllowedCollisions::claimed_pairs) that are proven out of reach: the
// two links keep the cell's clearance_m for all joint positions within the limits. Positions may
// exceed the limits by what the cell tolerates: checking.tracking_error_rad and
// execution.start_tolerance_rad. Never proves a pair wrongly; omits a pair if its proof exceeds the
// budget, or if capsules are too coarse for it. Deterministic. Precondition: `bodies` has all
// links.
[[nodiscard]] std::set<LinkPair> pairs_out_of_reach(const PlanningScene::Bodies& bodies);

}  // namespace armloom
