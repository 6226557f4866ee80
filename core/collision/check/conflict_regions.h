#pragma once

#include <cstddef>
#include <vector>

#include "core/coordination/conflict_region.h"

namespace armloom {

// A closed rectangle of states that are not certified free, and what is known of it.
struct BlockedCell {
  enum class Evidence {
    none,
    distance,  // a distance in it is known
    proven,    // a state in it is proven to be in conflict
  };
  ProgressBox box;
  Evidence evidence = Evidence::none;
  double distance_m = 0.0;  // where there is evidence
};

// Blocked cells that hang together.
struct BlockedRegion {
  std::vector<ProgressBox> boxes;  // by from_a, then from_b; never empty
  std::size_t evidence;            // place of the cell with the closest proven state; without one,
                                   // the smallest distance known; without one, the largest cell
};

// The connected components of the cells, each in few boxes that overlap by no more than kTouch.
// Cells belong together when they touch, corners and gaps up to kTouch included. Boxes hold every
// state of the cells that can still be reached; besides, only what a component (or several) closes
// in on all sides, for no motion comes there. `remaining`: where both may still come to. Cells that
// are behind it are dropped, and what is not blocked where both stand now is never filled.
//
// Precondition: a cell has no zero width, but on an axis on which all have (an arm at rest).
// Pure; by from_a and from_b of the first boxes.
[[nodiscard]] std::vector<BlockedRegion> blocked_regions(const std::vector<BlockedCell>& cells,
                                                         const ProgressBox& remaining);
inline constexpr Duration kTouch = std::chrono::nanoseconds(1);

}  // namespace armloom
