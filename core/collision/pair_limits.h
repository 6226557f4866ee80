#pragma once

#include "core/model/cell.h"

namespace armloom {

// What bodies keep from each other (m): an arm from other arms and all that stands still, and from
// itself (Cell::is_own).
struct PairLimits {
  double clearance_m;
  double self_clearance_m;

  [[nodiscard]] static PairLimits of(const Cell& cell) {
    return {cell.clearance_m, cell.self_clearance_m};
  }
  // Where `clearance_m` takes the place of the cell's, an arm keeps the same share of it from
  // itself as in the cell.
  [[nodiscard]] static PairLimits scaled(const Cell& cell, double clearance_m) {
    const double share = cell.clearance_m > 0.0 ? cell.self_clearance_m / cell.clearance_m : 1.0;
    return {clearance_m, clearance_m * share};
  }
};

}  // namespace armloom
