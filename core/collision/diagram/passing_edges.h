#pragma once

#include <vector>

#include "core/coordination/conflict_region.h"

namespace armloom {

// One leaf of a diagram that is not known to be free.
struct OpenLeaf {
  int cell;
  ProgressBox box;
  bool refinable = false;  // else it stays as it is
  bool proven = false;     // its middle is in conflict (of one that is not refinable: all of it)
};

// How fine the leaves have to be where motions pass them. A monotone path passes all of a region
// on one side, so of its outline only two staircases matter: the corners (to_a, from_b) with
// nothing of the region farther out in both, where A passes first, and the corners (from_a, to_b)
// where B does. Of these what counts most is the corner that a motion by the clock comes closest
// to: the largest to_a - from_b, and to_b - from_a. Leaves may be the coarser the farther they are
// behind it.
struct PassingResolution {
  Duration fine;    // at that corner, and where the region meets the rim of what is to come
  Duration coarse;  // nowhere wider than this
  double slope;     // by how much wider for each second behind
};

// A leaf that is to be made finer, on either side.
struct CoarseLeaf {
  int cell;
  Duration allowed;
  bool a_first;  // where A passes first
  bool b_first;
};

// The leaves that are wider than they may be; what hangs together (corners included) is one region.
// `remaining`: what of both motions is to come. Leaves do not overlap. In a fixed order; takes
// n log n. Pure.
[[nodiscard]] std::vector<CoarseLeaf> coarse_leaves(std::vector<OpenLeaf> leaves,
                                                    const ProgressBox& remaining,
                                                    const PassingResolution& resolution);

}  // namespace armloom
