#pragma once

#include <cstddef>
#include <vector>

#include "core/coordination/conflict_region.h"

namespace armloom {

// A closed rectangle of states that are not certified free.
struct BlockedCell {
  enum class Evidence {
    none,
    distance,  // a distance is known
    proven,    // a state is proven to be in conflict
  };
  ProgressBox box;
  Evidence evidence = Evidence::none;
  double distance_m = 0.0;  // unset without evidence
};

struct BlockedRegion {
  std::vector<ProgressBox> boxes;  // by from_a, then from_b; never empty
  std::size_t evidence;  // cell with the closest proven state, else the smallest distance, else the
                         // largest cell
};

// Returns the connected components of the cells, each as few boxes that overlap by at most kTouch.
// Corners and gaps up to kTouch connect. The boxes cover all reachable states of the cells, and
// holes that components enclose, because no motion gets there. `remaining` is what remains of both
// motions: cells behind it are dropped, and a free state where both are now is never filled. Sorted
// by from_a and from_b of the first boxes. Pure.
//
// Precondition: no cell has zero width, except on an axis on which all have (an arm at rest).
[[nodiscard]] std::vector<BlockedRegion> blocked_regions(const std::vector<BlockedCell>& cells,
                                                         const ProgressBox& remaining);
inline constexpr Duration kTouch = std::chrono::nanoseconds(1);

}  // namespace armloom
