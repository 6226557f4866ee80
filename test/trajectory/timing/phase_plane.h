#pragma once

#include "core/trajectory/timing/joint_path.h"
#include "core/trajectory/timing/joint_rates.h"

namespace armloom::testing {

// Returns the least time along a path from rest to rest within velocity and acceleration limits, at
// `steps` even steps of s. Phase plane (Bobrow, Dubowsky and Gibson 1985; Shin and McKay 1985): the
// speed is bounded by the maximum velocity curve, and by the largest acceleration and deceleration.
// Shares no code with the code under test. With more steps the result decreases to the true time,
// or rises to it if the curve itself cannot be followed.
[[nodiscard]] double least_time_s(const JointPath& path, const JointRates& rates,
                                  std::size_t steps);

}  // namespace armloom::testing
