#pragma once

#include <optional>

#include "core/jobs/job.h"

namespace armloom {

// Measured speed of motions.

// A starting or braking arm may be measured at one position for this long.
inline constexpr Duration kStandsFrom = std::chrono::milliseconds(250);

// Returns true if the motion has not moved for kStandsFrom.
[[nodiscard]] bool is_standing(const Moving& moving, TimePoint now);

// Returns since when the job's arms rest although no order holds them (late, stalled, stopped).
[[nodiscard]] std::optional<TimePoint> stands_since(const Job& job);
// Returns how long they have rested so; zero below kStandsFrom.
[[nodiscard]] Duration stood_for(const Job& job, TimePoint now);

// Returns cell time per trajectory time since the last rest; 1 if about as planned, or not known.
[[nodiscard]] double pace_of(const Job& job, TimePoint now);

}  // namespace armloom
