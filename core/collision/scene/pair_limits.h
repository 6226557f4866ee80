#pragma once

#include <limits>

#include "core/model/cell.h"

namespace armloom {

// Required distances (m) of an arm from
// - other arms and static bodies: clearance_m
// - itself (Cell::is_own): self_clearance_m
// - its mount (Cell::is_mount): mount_clearance_m, but at most clearance_m
struct PairLimits {
  double clearance_m;
  double self_clearance_m;
  double mount_clearance_m = std::numeric_limits<double>::infinity();

  [[nodiscard]] static PairLimits of(const Cell& cell) {
    return {cell.clearances.clearance_m, cell.clearances.self_clearance_m,
            cell.clearances.mount_limit_m()};
  }
  // Returns limits with another clearance_m. The other two limits are scaled by the same factor.
  [[nodiscard]] static PairLimits scaled(const Cell& cell, double clearance_m) {
    const PairLimits own = of(cell);
    const auto share = [&](double limit_m) {
      return own.clearance_m > 0.0 ? clearance_m * (limit_m / own.clearance_m) : clearance_m;
    };
    return {clearance_m, share(own.self_clearance_m), share(own.mount_clearance_m)};
  }
};

}  // namespace armloom
