#pragma once

#include <optional>

#include "core/jobs/transitions.h"

namespace armloom {

// For policies without passing orders (timed_discrete).

// Call when an arm brakes, or rests off its goal. All motions under way will be checked again.
// Scheduled jobs whose arms are stopped return to the queue.
void compare_again(Transitions& state);
// Does the same if an arm under way has newly come to rest (late, stalled).
void see_standing(Transitions& state);
// Returns when see_standing() must be called next.
[[nodiscard]] std::optional<TimePoint> stands_next(const State& state);

}  // namespace armloom
