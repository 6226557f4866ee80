#pragma once

#include <vector>

#include "core/model/cell.h"

namespace armloom {

// The largest distance of each arm's joints from their path (rad, m). Certificates allow for it.
class TrackingErrors {
 public:
  // The same error for all arms.
  TrackingErrors(double all) : all_(all) {}  // NOLINT(google-explicit-constructor): as a number
  // Takes the promises of the cell's controllers (Cell::tracking_error).
  explicit TrackingErrors(const Cell& cell) {
    for (const Arm& arm : cell.arms) by_arm_.push_back(cell.tracking_error(arm.robot));
  }
  [[nodiscard]] double of(ArmId arm) const { return by_arm_.empty() ? all_ : by_arm_[arm.index()]; }

 private:
  double all_ = 0.0;
  std::vector<double> by_arm_;  // by ArmId; empty if all_ applies
};

}  // namespace armloom
