#pragma once

#include <vector>

#include "core/coordination/conflict_region.h"

namespace armloom {

// A leaf of a diagram that is not free.
struct OpenLeaf {
  int cell;
  ProgressBox box;
  bool refinable = false;  // false if the leaf stays blocked as a whole
  bool proven = false;     // its middle is in conflict
};

// How narrow leaves must be where motions pass a region. A monotone path passes a region on one
// side, A first or B first. So only two staircases of the region's outline matter:
// - A first: the corners (to_a, from_b) for which no corner of the region has both a larger to_a
//   and a smaller from_b
// - B first: the corners (from_a, to_b), with A and B exchanged
// If both motions run without waiting, they come closest to the corner with the largest to_a -
// from_b (or to_b - from_a). Leaves may be wider, the farther they are behind this corner.
struct PassingResolution {
  Duration fine;    // maximum width at this corner, and at the border of what remains
  Duration coarse;  // maximum width anywhere on the staircases
  double slope;     // allowed width per second that a leaf is behind the corner
};

// A leaf that is too wide.
struct CoarseLeaf {
  int cell;
  Duration allowed;  // maximum width
  bool a_first;      // too wide where A passes first
  bool b_first;      // too wide where B passes first
};

// Returns the leaves that are too wide, in a fixed order. Leaves that touch, corners included, form
// one region. `remaining`: what remains of both motions. Precondition: leaves do not overlap. Takes
// O(n log n) time, and time for all leaves at each start of a leaf along A. Pure.
[[nodiscard]] std::vector<CoarseLeaf> coarse_leaves(std::vector<OpenLeaf> leaves,
                                                    const ProgressBox& remaining,
                                                    const PassingResolution& resolution);

}  // namespace armloom
