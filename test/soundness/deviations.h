#pragma once

#include "core/coordination/verdict.h"
#include "test/soundness/pairs.h"

namespace armloom::soundness {

// Progress of both motions of a pair.
struct PlaceOfPair {
  Duration own_time;
  Duration other_time;
};
// Each joint is up to `tracking_error` off its path, from `throws` random deviations.
struct DeviationAttack {
  double tracking_error;
  int throws;
  double horizon_m;  // larger distances are not computed
};

// Returns the smallest exact distance found at a place or within 50 ms of it. Steps downhill, joint
// by joint and time by time, from the place and from each random deviation.
[[nodiscard]] double closest_with_deviations(bench::ExactScene& exact, const MovingPair& pair,
                                             const PlaceOfPair& place,
                                             const DeviationAttack& attack,
                                             std::mt19937_64& random);

}  // namespace armloom::soundness
