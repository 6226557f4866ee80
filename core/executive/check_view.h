#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/coordination/verdict.h"
#include "core/executive/events.h"

namespace armloom {

// The answer to "what if": the Verdict of the design.
struct CheckView {
  Verdict::Kind kind = Verdict::Kind::free;
  std::optional<double> earliest_start_s;        // from now; absent: not known
  std::optional<double> clearance_bound_m;       // ClearanceBound; absent: nothing is proven
  std::optional<double> self_clearance_bound_m;  // likewise
  std::vector<WaitView> conflicts;
  std::uint64_t evaluations = 0;
  std::uint64_t scene_version = 0;

  void tell(const std::optional<ClearanceBound>& bound) {
    if (!bound) return;
    clearance_bound_m = bound->apart_m;
    self_clearance_bound_m = bound->self_m;
  }
};

}  // namespace armloom
