#pragma once

#include <vector>

#include "core/trajectory/rate_law.h"

namespace armloom {

// The largest rate (trajectory time per time) at each progress from which a brake still brings the
// arm to rest at `authority`. Integrated backwards with the deceleration of RateLaw, like the
// decelerating arc of time-optimal path following. Solutions of one differential equation do not
// cross, so an arm that brakes below the curve stays below it.
class BrakingCurve {
 public:
  BrakingCurve() { squares_.reserve(1024); }

  // Computes the curve backwards from `authority`, until it reaches rate one (and no longer limits
  // the arm) or `from`. Takes about 0.1 us per millisecond of trajectory time.
  void compute(RateLaw& law, Duration from, Duration authority);

  [[nodiscard]] Duration authority() const { return authority_; }
  // Returns the progress up to which any rate in [0, 1] is allowed. At or before compute()'s `from`
  // if the curve still limits the rate there.
  [[nodiscard]] Duration free_until() const { return free_until_; }
  // Returns the square of the largest rate at `progress_s`; zero from the authority on.
  [[nodiscard]] double rate_squared(double progress_s) const;

 private:
  Duration authority_{};
  Duration free_until_{};
  double authority_s_ = 0.0;
  // Squared rates at authority - k * kStep; linear in between (constant s'').
  std::vector<double> squares_;
};

}  // namespace armloom
