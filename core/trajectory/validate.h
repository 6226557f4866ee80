#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "core/model/cell.h"
#include "core/trajectory/trajectory.h"

namespace armloom {

// A trajectory from a client, in the shape of trajectory_msgs/JointTrajectory, unchecked.
struct WaypointRequest {
  std::vector<double> positions;      // rad or m, in the order of joint_names
  std::vector<double> velocities;     // empty if not given
  std::vector<double> accelerations;  // empty if not given
  // Rounded to the nearest nanosecond; NaN if not given.
  double time_from_start_s = std::numeric_limits<double>::quiet_NaN();
};
struct TrajectoryRequest {
  std::vector<std::string> joint_names;  // any order, kept by Trajectory::joints()
  std::vector<WaypointRequest> points;
  // Times, velocities and accelerations are computed (retime.h).
  struct Retime {
    std::optional<double> velocity = {};  // share of the joint velocities; the cell's if nullopt
    bool only_if_needed = false;          // only if the trajectory as given is not valid
  };
  std::optional<Retime> retime = {};
  // If given: joint names may lack the prefix of this arm's robot.
  std::string arm = {};
  double scaled_by = 1.0;     // product of the factors of slow_down()
  bool is_made_here = false;  // by the server: a refusal names no remedy
};
// Stretches the motion in time, as MoveIt's velocity scaling: times are divided by `factor`, in
// (0, 1]. Times made by `retime` use the factor instead of the cell's.
void slow_down(TrajectoryRequest& request, double factor);

// Larger requests are refused before anything is computed.
inline constexpr std::size_t kWaypointsMax = 10'000;
inline constexpr double kDurationMax_s = 3600.0;
// A shorter time between waypoints would make coefficients of t^5 meaningless.
inline constexpr double kSegmentMin_s = 1e-6;
// A waypoint that repeats the previous one's state so soon after it is dropped.
inline constexpr double kRepeat_s = 1e-3;
// First and last velocities up to this are rounded zeros and become exactly zero; rad/s.
inline constexpr double kRestVelocity = 1e-4;
// Tolerance of position limits at waypoints (rounding by planners) and between waypoints
// (overshooting splines); rad or m.
inline constexpr double kPositionTolerance = 1e-6;
inline constexpr double kPositionOvershoot = 1e-4;
// Returns true if a waypoint may have this position.
[[nodiscard]] inline bool is_within_limits(const Joint& joint, double position) {
  return position >= joint.lower - kPositionTolerance &&
         position <= joint.upper + kPositionTolerance;
}

// Checks a request and returns its trajectory. Requests with `retime` go to retimed()
// (timing/retime.h); with `only_if_needed`, only if they are not valid as given. If a request
// is not valid, waypoints that repeat the one before them (positions within kPositionTolerance,
// velocities within kRestVelocity, less than kRepeat_s later) are dropped.
// If the motion breaks only limits of velocity or acceleration, the first problem names the largest
// velocity scaling factor that passes. Checks in this order:
//  names:  known ("unknown-joint"), of an arm ("joint-of-no-arm"), once each ("duplicate-joint"),
//          every joint of each arm that moves ("missing-joint"); gripper joints are optional,
//          joints of several arms make one motion;
//  shape:  "empty-trajectory", "too-few-points" (one), "too-many-points"; one number for each joint
//          in positions, velocities, accelerations ("size-mismatch", "no-velocities"; accelerations
//          in all waypoints or in none: "partial-accelerations"); "not-finite"; times: zero at
//          first ("first-time-not-zero", "negative-time"), ascending by kSegmentMin_s or more
//          ("time-not-increasing"), "too-long";
//  motion: only if names and shape are right: first and last velocities within kRestVelocity of
//          zero ("not-at-rest"); limits at every waypoint as given, and *between* waypoints by
//          bounds that hold for every instant (core/trajectory/polynomial.h):
//            "position-limit":     within [lower, upper], kPositionTolerance more at waypoints,
//                                  kPositionOvershoot more between them;
//            "velocity-limit", "acceleration-limit": |v|, |a| up to the joint's limit times
//                                  (1 + cell.checking.limit_tolerance), at and between waypoints.
//          A cubic's acceleration jumps at waypoints: both one-sided values are checked, each as
//          the end of its segment. Given accelerations need not be zero at the ends.
// Problems point into the request, "/points/14/velocities/3", with the value found. A limit that is
// broken only between waypoints is reported at the later waypoint, "/points/14", with the worst
// value; a missing member at its object. The caller prepends its prefix ("/trajectory"). Returns
// all problems of the stages that were reached, at most kProblemsMax. Thread-safe. About 0.1 ms for
// 100 waypoints of 7 joints.
inline constexpr std::size_t kProblemsMax = 20;
[[nodiscard]] Result<TrajectoryPtr> validate(const TrajectoryRequest& request, const Cell& cell);

}  // namespace armloom
