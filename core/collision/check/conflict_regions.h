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
  // Index of the cell with the best evidence: the closest proven conflict, else the smallest known
  // distance, else the largest area.
  std::size_t evidence;
};

// Returns the connected components of the cells, each as few boxes that overlap by at most kTouch.
// Cells that touch in a corner, or have a gap of at most kTouch, are connected. The boxes cover all
// states of the cells that motions can reach. They also cover holes that a component encloses,
// because no motion can get into a hole.
//
// `remaining`: what remains of both motions. Cells that the motions have passed are dropped. A hole
// that contains the present state of both motions is not covered. Regions are sorted by from_a and
// from_b of their first box. Pure.
//
// Precondition: a cell has zero width only along the axis of an arm at rest; then all cells have.
[[nodiscard]] std::vector<BlockedRegion> blocked_regions(const std::vector<BlockedCell>& cells,
                                                         const ProgressBox& remaining);
inline constexpr Duration kTouch = std::chrono::nanoseconds(1);

}  // namespace armloom
