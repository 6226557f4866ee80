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

// A motion that starts farther off its path than the tracking error is certified for a larger
// error. Two measurements of one position differ by up to the tracking error; so the monitor allows
// for one of them, and certificates for both.
[[nodiscard]] inline double certified_error(double off_path, double tracking_error) {
  return off_path > tracking_error ? off_path + 2.0 * tracking_error : off_path;
}
[[nodiscard]] inline double observed_limit(double off_path, double tracking_error) {
  return off_path > tracking_error ? off_path + tracking_error : tracking_error;
}

}  // namespace armloom
