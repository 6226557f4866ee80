#pragma once

#include <optional>

#include "core/jobs/job.h"

namespace armloom {

// How fast motions go, seen from outside.

// An arm that sets out or brakes may be seen so long in one place.
inline constexpr Duration kStandsFrom = std::chrono::milliseconds(250);

// It has not been seen to move for longer than an arm that sets out or brakes.
[[nodiscard]] bool is_standing(const Moving& moving, TimePoint now);

// Since when its arms have stood for no reason of ours: late, stalled, stopped; nothing: they move,
// or wait for others.
[[nodiscard]] std::optional<TimePoint> stands_since(const Job& job);
// How long its arms have stood for no reason of ours: late, stalled, stopped. Zero: it moves, or
// waits for others.
[[nodiscard]] Duration stood_for(const Job& job, TimePoint now);

// Of cell time for one of its trajectory, as it has gone since it last stood; 1: at about the speed
// that it was to have, or not known.
[[nodiscard]] double pace_of(const Job& job, TimePoint now);

}  // namespace armloom
