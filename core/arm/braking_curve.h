#pragma once

#include <vector>

#include "core/arm/rate_law.h"

namespace armloom {

// The largest rate at which an arm may pass each place of its path so that a brake still brings it
// to rest at `authority`: integrated backwards from there with the rate law's deceleration (the
// decelerating arc of time-optimal path following). Solutions of one differential equation do not
// cross: an arm below the curve that brakes stays below it.
class BrakingCurve {
 public:
  BrakingCurve() { squares_.reserve(1024); }

  // Computes the curve from `authority` back to where it no longer binds (rate one), at most to
  // `from`. About 0.1 us for each millisecond of trajectory time.
  void compute(RateLaw& law, Duration from, Duration authority);

  [[nodiscard]] Duration authority() const { return authority_; }
  // Up to here any rate in [0, 1] is allowed; at or before the `from` of compute() if it binds
  // there.
  [[nodiscard]] Duration free_until() const { return free_until_; }
  // The square of the largest rate at `progress` (seconds); zero from the authority on.
  [[nodiscard]] double rate_squared(double progress_s) const;

 private:
  Duration authority_{};
  Duration free_until_{};
  double authority_s_ = 0.0;
  std::vector<double> squares_;  // at authority - k * kStep: linear in between (constant s'')
};

}  // namespace armloom
