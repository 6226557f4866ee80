#pragma once

#include <optional>
#include <string>

#include "core/collision/arbiter.h"
#include "test/soundness/pairs.h"

namespace armloom::soundness {

// What a method promises of a free pair, spelled out here a second time: how far each motion may be
// off its plan (seconds of trajectory time) and off its path (each joint).
struct Promise {
  double lag_candidate_s = 0.0;
  double lag_other_s = 0.0;
  double lead_candidate_s = 0.0;
  double lead_other_s = 0.0;
  double tracking_error = 0.0;
};
[[nodiscard]] Promise promise_of(const Cell& cell, const MovingPair& pair,
                                 const CheckMethod& method);

// Looks for the state within the promise in which the arms come closest: random times, delays,
// stops and joint deviations (their extremes among them), then steps from the best one, each kept
// when it brings them closer. Returns the smallest exact distance found (at most horizon_m).
struct Attack {
  double distance_m;
  double t_s, ahead_candidate_s, ahead_other_s;
  Configuration q;  // empty where nothing is below the horizon
};
[[nodiscard]] Attack attack(bench::ExactScene& exact, const MovingPair& pair,
                            const Promise& promise, double horizon_m, std::mt19937_64& random);

// The same two motions with the candidate starting so late, after the pair's own start, that the
// arbiter has just ceased to call it a conflict of the two (to 0.1 ms): free, but hardly. Nothing
// where it is free at its own start, or at none of the later ones that were tried.
[[nodiscard]] std::optional<MovingPair> hardly_free(Arbiter& arbiter, bench::ExactScene& exact,
                                                    const MovingPair& pair,
                                                    const CheckMethod& method);

}  // namespace armloom::soundness
