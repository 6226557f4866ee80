#pragma once

#include <vector>

#include "core/coordination/conflict_region.h"

namespace armloom {

struct OpenLeaf {
  int cell;
  ProgressBox box;
  bool refinable = false;  // false: it stays as it is
  bool proven = false;     // its middle is in conflict (all of it, if not refinable)
};

// How fine leaves must be where motions pass them. A monotone path passes a region on one side, so
// only two staircases of its outline matter: the corners (to_a, from_b) with no part of the region
// farther out in both, where A passes first; and the corners (from_a, to_b), where B does. A motion
// by the clock comes closest to the largest to_a - from_b, or to_b - from_a. Leaves may be coarser
// the farther they are behind that corner.
struct PassingResolution {
  Duration fine;    // at that corner, and at the border of what remains
  Duration coarse;  // maximum width
  double slope;     // allowed width per second behind
};

struct CoarseLeaf {
  int cell;
  Duration allowed;
  bool a_first;  // where A passes first
  bool b_first;
};

// Returns the leaves that are too wide, in a fixed order. Leaves that touch, corners included, form
// one region. `remaining`: of both motions. Precondition: leaves do not overlap. Takes n log n.
// Pure.
[[nodiscard]] std::vector<CoarseLeaf> coarse_leaves(std::vector<OpenLeaf> leaves,
                                                    const ProgressBox& remaining,
                                                    const PassingResolution& resolution);

}  // namespace armloom
