#pragma once

#include "core/base/problem.h"
#include "core/trajectory/trajectory.h"
#include "core/trajectory/validate.h"

namespace armloom {

// A trajectory of which only the way counts: times, velocities and accelerations are made
// (time_path), whatever it has of them. Straight from waypoint to waypoint, at rest at both ends
// only; corners are cut by kRetimeWithin at most (Euclidean, rad or m), waypoints included that are
// no corners: those that lie within kThinWithin of the chord between others are left out, as a path
// that was sampled closely has more of them than a motion may have. Problems: names and shape as
// validate(); "position-limit" at a waypoint, with its pointer; "no-way" where all waypoints are
// one place; "too-many-points" where what is made would have more than kWaypointsMax; else what
// time_path found, at "/points". Precondition: request.retime. Thread-safe.
inline constexpr double kRetimeWithin = 0.01;
inline constexpr double kThinWithin = 1e-3;
[[nodiscard]] Result<TrajectoryPtr> retimed(const TrajectoryRequest& request, const Cell& cell);

}  // namespace armloom
