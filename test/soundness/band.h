#pragma once

#include <optional>
#include <string>

#include "core/collision/check/motion_checker.h"
#include "test/soundness/pairs.h"

namespace armloom::soundness {

// Result of a search for the closest states of two remaining motions. Each joint may be up to
// `tracking_error` off its path. The search starts from random and extreme states, then keeps each
// step that brings the arms closer.
struct Attack {
  double distance_m;
  double candidate_s, other_s;  // trajectory times
};
[[nodiscard]] Attack attack(bench::ExactScene& exact, const MovingPair& pair, double tracking_error,
                            double horizon_m, std::mt19937_64& random);

// Delays the candidate until the motions just miss all regions (to 0.1 ms). Returns nullopt if the
// motions meet no region without delay, or still meet a region after every tried delay.
[[nodiscard]] std::optional<MovingPair> hardly_free(const Verdict& regions, const MovingPair& pair);

}  // namespace armloom::soundness
