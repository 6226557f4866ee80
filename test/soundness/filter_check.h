#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/model/cell.h"

namespace armloom::soundness {

// Result of comparing the filter with exact shapes, at states with all joints uniform within their
// limits.
struct FilterReport {
  std::size_t states = 0;
  std::size_t part_pairs = 0;         // compared
  std::size_t by_fcl = 0;             // of these, also compared with plain FCL
  std::size_t left_out = 0;           // scene pairs in no comparison: must be 0
  std::size_t too_far = 0;            // filter distances above the exact distance: must be 0
  double worst_m = 0.0;               // largest excess
  double margin_m = 0.0;              // the largest rounding margin of any pair
  std::vector<std::string> failures;  // the first few
};
// Compares the smallest filter distance of each pair of parts (arm and arm, arm and itself, arm and
// static) with body_distance() at independent poses from forward_kinematics(). Near pairs are also
// compared with plain FCL.
[[nodiscard]] FilterReport check_filter(const CellPtr& cell, std::size_t states,
                                        std::uint64_t seed);

// Reads a cell of the config folder; throws its problems.
[[nodiscard]] CellPtr cell_of_file(const std::string& name);

}  // namespace armloom::soundness
