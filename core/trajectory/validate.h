#pragma once

#include <string>
#include <vector>

#include "core/base/problem.h"
#include "core/model/cell.h"
#include "core/trajectory/trajectory.h"

namespace armloom {

// A trajectory as a client sent it: the shape of trajectory_msgs/JointTrajectory, nothing checked.
struct WaypointRequest {
  std::vector<double> positions;      // rad or m, in the order of joint_names
  std::vector<double> velocities;     // empty: not given
  std::vector<double> accelerations;  // empty: not given
  double time_from_start_s = 0.0;
};
struct TrajectoryRequest {
  std::vector<std::string> joint_names;
  std::vector<WaypointRequest> points;
};

// More than this and the request is refused as too large before anything is computed.
inline constexpr std::size_t kWaypointsMax = 10'000;
inline constexpr double kDurationMax_s = 3600.0;

// Parse, then trust. Checks names (known, once each, every joint of each arm that is touched;
// gripper joints are optional), sizes, finite numbers, at least two waypoints, first at time zero,
// strictly increasing times, velocities given, start and end at rest, and position, velocity and
// acceleration limits at and *between* waypoints, each with the cell's checking.limit_tolerance for
// velocity and acceleration (positions may overshoot between waypoints by the same share of nothing:
// by at most 1e-6). Where accelerations are absent in some waypoints they must be absent in all.
// Problems point into the request: "/points/14/velocities/3" with the value found; the caller puts
// its own prefix ("/trajectory") in front. All problems are returned, at most kProblemsMax.
inline constexpr std::size_t kProblemsMax = 20;
[[nodiscard]] Result<TrajectoryPtr> validate(const TrajectoryRequest& request, const Cell& cell);

}  // namespace armloom
