#pragma once

#include <optional>
#include <string>

#include "core/collision/check/motion_checker.h"
#include "test/soundness/pairs.h"

namespace armloom::soundness {

// Looks for the state of what remains of both motions in which the arms come closest, each joint up
// to `tracking_error` off its path: random places and deviations (their extremes among them), then
// steps from the best one, each kept when it brings them closer. Returns the smallest exact
// distance found (at most horizon_m).
struct Attack {
  double distance_m;
  double candidate_s, other_s;  // trajectory times
};
[[nodiscard]] Attack attack(bench::ExactScene& exact, const MovingPair& pair, double tracking_error,
                            double horizon_m, std::mt19937_64& random);

// The same two motions with the candidate starting so late, after the pair's own start, that they
// have just ceased to meet a region (to 0.1 ms): free, but hardly. Nothing where they meet none at
// the pair's own start, or some at each of the later ones that were tried.
[[nodiscard]] std::optional<MovingPair> hardly_free(const Verdict& regions, const MovingPair& pair);

}  // namespace armloom::soundness
