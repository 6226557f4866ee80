#pragma once

#include <optional>

#include "core/jobs/job.h"

namespace armloom {

// Measured speed of motions.

// A starting or braking arm may be measured at one position for this long.
inline constexpr Duration kStandsFrom = std::chrono::milliseconds(250);

// Returns true if the motion has not moved for kStandsFrom or longer.
[[nodiscard]] bool is_standing(const Moving& moving, TimePoint now);

// Returns since when the job's arms rest without being held back by orders (late, stalled,
// stopped); nullopt if they move or wait for other motions.
[[nodiscard]] std::optional<TimePoint> stands_since(const Job& job);
// Returns how long the job's arms have rested in this way; zero if shorter than kStandsFrom.
[[nodiscard]] Duration stood_for(const Job& job, TimePoint now);

// Returns the ratio of cell time to trajectory time since the last standstill; 1 if about as
// planned, or not known.
[[nodiscard]] double pace_of(const Job& job, TimePoint now);

}  // namespace armloom
