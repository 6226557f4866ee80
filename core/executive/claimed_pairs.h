#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "core/model/cell.h"

namespace armloom {

// How the pairs of links are treated that an SRDF disables although they might collide
// (AllowedCollisions::claimed_pairs).
struct ClaimedPairsReport {
  struct Pair {
    std::string link_a;
    std::string link_b;
    std::string place;  // "arm.srdf:17"
  };
  std::size_t out_of_reach = 0;  // pairs proven out of reach: not checked
  std::size_t cell_file = 0;     // pairs that the cell file allows: not checked
  std::vector<Pair> checked;     // pairs that are checked although the SRDF disables them
};

// Problems: those of PlanningScene::build.
[[nodiscard]] Result<ClaimedPairsReport> report_claimed_pairs(CellPtr cell);

// Returns one sentence with the three numbers and up to three of the checked pairs; empty if there
// are no such pairs.
[[nodiscard]] std::string to_text(const ClaimedPairsReport& report);

}  // namespace armloom
