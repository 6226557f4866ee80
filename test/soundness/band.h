#pragma once

#include <optional>
#include <string>

#include "core/collision/check/motion_checker.h"
#include "test/soundness/pairs.h"

namespace armloom::soundness {

// Searches the remaining states of both motions for the smallest distance, each joint up to
// `tracking_error` off its path. Starts from random states and deviations, including extremes, then
// keeps each step that brings the arms closer. Returns the smallest exact distance found, at most
// horizon_m.
struct Attack {
  double distance_m;
  double candidate_s, other_s;  // trajectory times
};
[[nodiscard]] Attack attack(bench::ExactScene& exact, const MovingPair& pair, double tracking_error,
                            double horizon_m, std::mt19937_64& random);

// Returns the pair with the candidate delayed until the motions just miss all regions (to 0.1 ms):
// free, but hardly. Returns nullopt if they meet no region without delay, or still meet one after
// every tried delay.
[[nodiscard]] std::optional<MovingPair> hardly_free(const Verdict& regions, const MovingPair& pair);

}  // namespace armloom::soundness
