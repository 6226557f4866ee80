#pragma once

#include "core/coordination/verdict.h"
#include "test/soundness/pairs.h"

namespace armloom::soundness {

// Where one arm of a pair is on its way, and the other on its own.
struct PlaceOfPair {
  Duration own_time;
  Duration other_time;
};
// What is tried: each joint up to `tracking_error` off its path, from `throws` random deviations.
struct DeviationAttack {
  double tracking_error;
  int throws;
  double horizon_m;  // what is farther apart is not told
};

// The smallest exact distance of the two arms of a pair that is found at a place, or within 50 ms
// of it: steps downhill, joint by joint and time by time, from there and from each throw.
[[nodiscard]] double closest_with_deviations(bench::ExactScene& exact, const MovingPair& pair,
                                             const PlaceOfPair& place,
                                             const DeviationAttack& attack,
                                             std::mt19937_64& random);

}  // namespace armloom::soundness
