#pragma once

#include "core/trajectory/timing/joint_path.h"
#include "core/trajectory/timing/joint_rates.h"

namespace armloom::testing {

// Returns the least time along a path from rest to rest within velocity and acceleration limits.
// Uses the phase plane (Bobrow, Dubowsky and Gibson 1985; Shin and McKay 1985) at `steps` even
// steps of s. The speed is bounded by the maximum velocity curve, by the largest acceleration from
// the start, and by the largest deceleration to the end. Path derivatives are differences of
// positions; no code is shared with the code under test. With more steps the result decreases to
// the true time, or rises to it if the maximum velocity curve itself cannot be followed.
[[nodiscard]] double least_time_s(const JointPath& path, const JointRates& rates,
                                  std::size_t steps);

}  // namespace armloom::testing
