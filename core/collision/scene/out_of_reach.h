#pragma once

#include <set>

#include "core/collision/scene/scene_bodies.h"

namespace armloom {

// Largest number of comparisons of two link parts (SweptLink::Part): for one pair of links, and for
// all pairs of a cell together.
inline constexpr int kComparisonsPerPair = 4'000;
inline constexpr int kComparisonsPerCell = 2'000'000;

// Returns the pairs that an SRDF disables without proof (AllowedCollisions::claimed_pairs) and that
// are proven to keep the cell's clearance_m. The proof covers all joint positions within the
// limits, exceeded by up to the robot's tracking error and execution.start_tolerance_rad.
// Every returned pair is proven. A pair is missing if its proof exceeds the budget or if the links'
// capsules are too coarse. Deterministic. Precondition: `bodies` already contains all links.
[[nodiscard]] std::set<LinkPair> pairs_out_of_reach(const PlanningScene::Bodies& bodies);

}  // namespace armloom
