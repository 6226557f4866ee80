#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/model/cell.h"

namespace armloom::soundness {

// The filter against exact shapes, in random states of a cell: all joints uniform within their
// limits, gripper joints too.
struct FilterReport {
  std::size_t states = 0;
  std::size_t part_pairs = 0;         // compared
  std::size_t by_fcl = 0;             // of these, held against plain FCL too
  std::size_t left_out = 0;           // pairs of the scene that no comparison has: must be none
  std::size_t too_far = 0;            // the filter's distance above the exact one: must be none
  double worst_m = 0.0;               // by how much at most
  double margin_m = 0.0;              // the largest rounding margin of any pair
  std::vector<std::string> failures;  // the first few
};
// The smallest distance of the filter over the capsules of each two parts (arm and arm, arm and
// itself, arm and what stands still) is held against body_distance() at poses from
// forward_kinematics(), which shares nothing with the filter's own; for near pairs both are held
// against plain FCL as well (plain_fcl.h).
[[nodiscard]] FilterReport check_filter(const CellPtr& cell, std::size_t states,
                                        std::uint64_t seed);

// A cell of this repository's config folder. Throws what is wrong with it.
[[nodiscard]] CellPtr cell_of_file(const std::string& name);

}  // namespace armloom::soundness
