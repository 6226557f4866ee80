#pragma once

#include <optional>

#include "core/jobs/state.h"

namespace armloom {

// For policies without passing orders (timed_discrete).

// Call when an arm brakes, or rests off its goal. All motions under way will be checked again.
// Scheduled jobs whose arms are stopped return to the queue.
void compare_again(State& state);
// Does the same if an arm under way has newly come to rest (late, stalled).
void see_standing(State& state);
// Returns when see_standing() must be called next.
[[nodiscard]] std::optional<TimePoint> stands_next(const State& state);

}  // namespace armloom
