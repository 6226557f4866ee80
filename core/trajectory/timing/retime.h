#pragma once

#include "core/base/problem.h"
#include "core/trajectory/trajectory.h"
#include "core/trajectory/validate.h"

namespace armloom {

// A trajectory of which only the way counts: times, velocities and accelerations are made
// (time_path), whatever it has of them. Straight from waypoint to waypoint, at rest at both ends
// only; corners are cut by kRetimeWithin at most (Euclidean, rad or m). Problems: names and shape
// as validate(); "position-limit" at a waypoint, with its pointer; "no-way" where all waypoints are
// one place; else what time_path found, at "/points". Precondition: request.retime. Thread-safe.
inline constexpr double kRetimeWithin = 0.01;
[[nodiscard]] Result<TrajectoryPtr> retimed(const TrajectoryRequest& request, const Cell& cell);

}  // namespace armloom
