#pragma once

#include <optional>

#include "core/jobs/state.h"

namespace armloom {

// For policies without passing orders (timed_discrete).

// When an arm brakes or rests off its goal: compares all motions under way again, and returns jobs
// that a stop keeps at their start to the queue.
void compare_again(State& state);
// The same when an arm under way is found at rest: late, stalled.
void see_standing(State& state);
// Returns when that is due next.
[[nodiscard]] std::optional<TimePoint> stands_next(const State& state);

}  // namespace armloom
