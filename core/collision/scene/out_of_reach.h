#pragma once

#include <set>

#include "core/collision/scene/scene_bodies.h"

namespace armloom {

// The budget of a proof, and of all proofs of a cell together: comparisons of two swept parts.
inline constexpr int kComparisonsPerPair = 4'000;
inline constexpr int kComparisonsPerCell = 2'000'000;

// Returns the claimed pairs (AllowedCollisions::claimed_pairs) that are proven out of reach: the
// two links keep the cell's clearance_m wherever their joints are within their limits. Joints may
// be outside by what the cell tolerates: checking.tracking_error_rad and
// execution.start_tolerance_rad. Never proves a pair wrongly; leaves out a pair whose proof takes
// more than the budget, or takes shapes closer than their capsules. Deterministic.
// Precondition: the bodies of all links are there.
[[nodiscard]] std::set<LinkPair> pairs_out_of_reach(const PlanningScene::Bodies& bodies);

}  // namespace armloom
