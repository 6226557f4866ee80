#pragma once

#include "core/base/problem.h"
#include "core/trajectory/trajectory.h"
#include "core/trajectory/validate.h"

namespace armloom {

// Computes times, velocities and accelerations along the path of a request (time_path()); given
// values are ignored. The motion rests only at both ends. Corners are cut by at most kRetimeWithin
// (Euclidean, rad or m). Waypoints within kThinWithin of the chord between others are dropped,
// because a densely sampled path may have too many waypoints. Precondition: request.retime.
// Thread-safe. Problems are:
// - those of names and shape, as in validate(),
// - "position-limit" with the pointer of the waypoint,
// - "no-way" if all waypoints are equal,
// - "too-many-points" if the result would have more than kWaypointsMax,
// - those of time_path(), at "/points".
inline constexpr double kRetimeWithin = 0.01;
inline constexpr double kThinWithin = 1e-3;
[[nodiscard]] Result<TrajectoryPtr> retimed(const TrajectoryRequest& request, const Cell& cell);

}  // namespace armloom
