#pragma once

#include <optional>

#include "core/jobs/step.h"

namespace armloom {

// Measured speed of motions.

// A job's arms stand if they have not moved for Promises::stands_from.

// Returns true if the job is moving but its arms stand.
[[nodiscard]] bool is_standing(const Cell& cell, const Step& step, TimePoint now);

// Returns since when the job's arms have not moved although no passing order holds them (late,
// stalled, stopped). For a moving job: the time of its last movement.
[[nodiscard]] std::optional<TimePoint> stands_since(const Step& step);
// Returns the time since stands_since(); zero if the arms do not stand yet.
[[nodiscard]] Duration stood_for(const Cell& cell, const Step& step, TimePoint now);

// Returns the cell time that the motion has taken per trajectory time since its last rest or change
// of speed override; `planned` (SpeedOverride::pace) if it goes about so, or if this is not known.
[[nodiscard]] double pace_of(const Cell& cell, const Step& step, double planned, TimePoint now);

}  // namespace armloom
