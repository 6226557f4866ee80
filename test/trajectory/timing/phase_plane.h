#pragma once

#include "core/trajectory/timing/joint_path.h"
#include "core/trajectory/timing/joint_rates.h"

namespace armloom::testing {

// The least time along a path within velocities and accelerations, from rest to rest, by the phase
// plane (Bobrow, Dubowsky and Gibson 1985; Shin and McKay 1985) at `steps` even steps of s: no
// faster than the maximum velocity curve, no faster than the largest acceleration from the
// beginning on, no faster than the largest deceleration to the end. Derivatives of the path by
// differences of positions; nothing is shared with what it judges. As steps grow it comes down to
// the time, from below where the curve itself cannot be followed.
[[nodiscard]] double least_time_s(const JointPath& path, const JointRates& rates,
                                  std::size_t steps);

}  // namespace armloom::testing
