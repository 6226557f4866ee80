#pragma once

#include <optional>

#include "core/jobs/job.h"

namespace armloom {

// Measured speed of motions.

// An arm is at rest if it has not moved for this long. A starting or braking arm may be measured at
// one position for a shorter time.
inline constexpr Duration kStandsFrom = std::chrono::milliseconds(250);

// Returns true if the motion has not moved for kStandsFrom.
[[nodiscard]] bool is_standing(const Moving& moving, TimePoint now);

// Returns since when the job's arms have not moved although no passing order holds them (late,
// stalled, stopped). For a moving job: the time of its last movement.
[[nodiscard]] std::optional<TimePoint> stands_since(const Job& job);
// Returns the time since stands_since(); zero if it is less than kStandsFrom.
[[nodiscard]] Duration stood_for(const Job& job, TimePoint now);

// Returns the cell time that the motion has taken per trajectory time since its last rest or change
// of speed override; `planned` (SpeedOverride::pace) if it goes about so, or if this is not known.
[[nodiscard]] double pace_of(const Job& job, double planned, TimePoint now);

}  // namespace armloom
