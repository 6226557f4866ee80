#pragma once

#include "core/coordination/verdict.h"
#include "test/soundness/pairs.h"

namespace armloom::soundness {

// Progress of both motions of a pair.
struct PlaceOfPair {
  Duration own_time;
  Duration other_time;
};
// How to search: from `throws` random deviations, with each joint up to its arm's error off its
// path.
struct DeviationAttack {
  TrackingErrors tracking_errors;
  int throws;
  double horizon_m;  // larger distances are not computed
};

// Returns the smallest exact distance found within 50 ms of the place. Starts without deviation and
// from each random deviation. Then changes one joint or one time after the other, as long as the
// distance falls.
[[nodiscard]] double closest_with_deviations(bench::ExactScene& exact, const MovingPair& pair,
                                             const PlaceOfPair& place,
                                             const DeviationAttack& attack,
                                             std::mt19937_64& random);

}  // namespace armloom::soundness
