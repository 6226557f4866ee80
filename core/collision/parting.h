#pragma once

#include <vector>

#include "core/collision/coordination_diagram.h"
#include "core/collision/pair_set.h"

namespace armloom {

// The pairs as they are judged where some are too close already and may part: each of these is
// held to `share` of the distance that it has.
[[nodiscard]] PairSet held_to_less(PairSet pairs,
                                   const std::vector<CoordinationDiagram::Close>& close,
                                   double share);

}  // namespace armloom
