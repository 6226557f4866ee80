#pragma once

#include <cstddef>
#include <vector>

#include "core/coordination/conflict_region.h"

namespace armloom {

// A closed rectangle of states that are not certified free, with its evidence.
struct BlockedCell {
  enum class Evidence {
    none,
    distance,  // a distance in it is known
    proven,    // a state in it is proven to be in conflict
  };
  ProgressBox box;
  Evidence evidence = Evidence::none;
  double distance_m = 0.0;  // unset without evidence
};

// Connected blocked cells.
struct BlockedRegion {
  std::vector<ProgressBox> boxes;  // sorted by from_a, then from_b; never empty
  std::size_t evidence;  // index of the cell with the closest proven state; if none, with the
                         // smallest known distance; if none, the largest cell
};

// Returns the connected components of the cells, each as few boxes that overlap by at most kTouch.
// Cells are connected if they touch, at corners too, or have gaps up to kTouch. The boxes contain
// every state of the cells that can still be reached. They also fill holes that one or more
// components enclose, because no motion gets there. `remaining` is what remains of both motions:
// cells behind it are dropped, and a free state where both are now is never filled.
//
// Precondition: no cell has zero width, except on an axis on which all cells have (an arm at rest).
// Pure. Sorted by from_a and from_b of the first boxes.
[[nodiscard]] std::vector<BlockedRegion> blocked_regions(const std::vector<BlockedCell>& cells,
                                                         const ProgressBox& remaining);
inline constexpr Duration kTouch = std::chrono::nanoseconds(1);

}  // namespace armloom
