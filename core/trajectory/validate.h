#pragma once

#include <limits>
#include <optional>
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
  // Rounded to the nearest nanosecond; NaN: not given.
  double time_from_start_s = std::numeric_limits<double>::quiet_NaN();
};
struct TrajectoryRequest {
  std::vector<std::string> joint_names;  // in any order; Trajectory::joints() keeps it
  std::vector<WaypointRequest> points;
  // Times, velocities and accelerations are made (retime.h); absent: as given.
  struct Retime {
    std::optional<double> velocity;  // share of the joints' speeds; absent: the cell's
  };
  std::optional<Retime> retime = {};
};

// More waypoints than this are refused as too large before anything is computed.
inline constexpr std::size_t kWaypointsMax = 10'000;
inline constexpr double kDurationMax_s = 3600.0;
// Waypoints closer than this would make coefficients of t^5 that mean nothing.
inline constexpr double kSegmentMin_s = 1e-6;
// First and last velocities up to this are taken for rounded zeros and become exactly zero; rad/s.
inline constexpr double kRestVelocity = 1e-4;
// How far a position may lie outside its limits at a waypoint (rounding in what planners print) and
// between waypoints (splines that swing out); rad or m.
inline constexpr double kPositionTolerance = 1e-6;
inline constexpr double kPositionOvershoot = 1e-4;
// Whether a waypoint may have the joint there.
[[nodiscard]] inline bool is_within_limits(const Joint& joint, double position) {
  return position >= joint.lower - kPositionTolerance &&
         position <= joint.upper + kPositionTolerance;
}

// Parse, then trust. Where times are to be made, retimed() (timing/retime.h) takes its place. In
// this order:
//  names:  known ("unknown-joint"), of an arm ("joint-of-no-arm"), once each ("duplicate-joint"),
//          every joint of each arm that is touched ("missing-joint"); gripper joints are optional,
//          joints of several arms make one motion of them all;
//  shape:  "empty-trajectory", "too-few-points" (one), "too-many-points"; one number for each joint
//          in positions, velocities, accelerations ("size-mismatch", "no-velocities"; accelerations
//          in all waypoints or in none: "partial-accelerations"); "not-finite"; times: zero at
//          first ("first-time-not-zero", "negative-time"), each kSegmentMin_s or more after the one
//          before ("time-not-increasing"), "too-long";
//  motion: only if all that is right: first and last velocities within kRestVelocity of zero
//          ("not-at-rest"); limits at every waypoint as given, and *between* waypoints by bounds
//          that hold for every instant (core/trajectory/polynomial.h):
//            "position-limit":     within [lower, upper], kPositionTolerance more at waypoints,
//                                  kPositionOvershoot more between them;
//            "velocity-limit", "acceleration-limit": |v|, |a| up to the joint's limit times
//                                  (1 + cell.checking.limit_tolerance), at and between waypoints.
//          A cubic's acceleration jumps at waypoints: both one-sided values are checked, each as
//          the end of its segment. Accelerations that are given need not be zero at the ends.
// Problems point into the request, "/points/14/velocities/3", with the value found; where a limit
// is broken only between waypoints, at the later one, "/points/14", with the worst value there; at
// the object where something is absent from it. The caller puts its prefix ("/trajectory") in
// front. All problems of the stages that were reached are returned, at most kProblemsMax.
// Thread-safe. About 0.1 ms for 100 waypoints of 7 joints.
inline constexpr std::size_t kProblemsMax = 20;
[[nodiscard]] Result<TrajectoryPtr> validate(const TrajectoryRequest& request, const Cell& cell);

}  // namespace armloom
