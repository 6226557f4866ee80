#pragma once

#include <optional>

#include "core/jobs/state.h"

namespace armloom {

// Policies without passing orders (timed_discrete): no order holds a motion back when another arm
// stops in its path, so motions are compared again.

// An arm begins to brake, or has come to rest elsewhere than at its goal: compares all motions
// under way again. Admitted motions that a stop keeps at their start wait in the queue again.
void compare_again(State& state);
// Does the same when an arm under way is found at rest: late, stalled.
void see_standing(State& state);
// Returns when the next arm will count as at rest, if it does not move before; nullopt if none.
[[nodiscard]] std::optional<TimePoint> stands_next(const State& state);

}  // namespace armloom
