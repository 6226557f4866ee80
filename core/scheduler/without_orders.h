#pragma once

#include <optional>

#include "core/jobs/state.h"

namespace armloom {

// Policies without passing orders (timed_discrete): nothing holds a motion back where another one
// has stopped in its way, so both are compared again.

// An arm begins to brake, or has come to rest elsewhere than at its goal. Motions that are under
// way are compared again; those that a stop has kept at their starts wait in the queue again.
void compare_again(State& state);
// The same where an arm under way is seen to stand: late, stalled.
void see_standing(State& state);
// When one is, if none of them moves before.
[[nodiscard]] std::optional<TimePoint> stands_next(const State& state);

}  // namespace armloom
