#pragma once

#include "core/coordination/verdict.h"
#include "test/soundness/pairs.h"

namespace armloom::soundness {

// The smallest exact distance of the two arms of a pair that is found where one of them is at
// `own_time` and the other at `other_time`, or within 50 ms of that, each joint up to
// `tracking_error` off its path: steps downhill, joint by joint and time by time, from there and
// from `throws` random deviations. At most horizon_m.
[[nodiscard]] double closest_with_deviations(bench::ExactScene& exact, const MovingPair& pair,
                                             Duration own_time, Duration other_time,
                                             double tracking_error, double horizon_m, int throws,
                                             std::mt19937_64& random);

}  // namespace armloom::soundness
