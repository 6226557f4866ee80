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
  // If set, times, velocities and accelerations are computed (retime.h).
  struct Retime {
    // Share of the joints' velocity limits; nullopt: the cell's.
    std::optional<double> velocity = {};
    bool only_if_needed = false;  // retime only if the trajectory is not valid as given
  };
  std::optional<Retime> retime = {};
  // If given: joint names may lack the prefix of this arm's robot.
  std::string arm = {};
  // JSON pointer to the trajectory in the job's body; nullopt: the usual place.
  std::optional<std::string> place = {};
  bool has_implicit_start = false;  // the first waypoint was inserted (implicit_start.h)
  double scaled_by = 1.0;           // product of the factors of slow_down()
  bool is_made_here = false;        // made by the server: a refusal names no remedy
};
// Stretches the motion in time, like velocity scaling in MoveIt: divides times by `factor`, which
// is in (0, 1]. If the request has `retime`, the factor replaces the cell's velocity scaling
// factor.
void slow_down(TrajectoryRequest& request, double factor);

// Returns the joint of this name, with or without the prefix of the robot of `arm`.
[[nodiscard]] std::optional<JointId> find_joint(const std::string& name, const std::string& arm,
                                                const Cell& cell);

// Larger requests are refused before anything is computed.
inline constexpr std::size_t kWaypointsMax = 10'000;
inline constexpr double kDurationMax_s = 3600.0;
// A shorter time between waypoints would make coefficients of t^5 meaningless.
inline constexpr double kSegmentMin_s = 1e-6;
// A waypoint that repeats the state of the previous waypoint within this time is dropped.
inline constexpr double kRepeat_s = 1e-3;
// First and last velocities up to this (rad/s) are taken as rounding errors and become exactly
// zero.
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
// (timing/retime.h); with `only_if_needed`, only if they are not valid as given. If a request is
// not valid, waypoints that repeat the previous waypoint are dropped: positions within
// kPositionTolerance, velocities within kRestVelocity, less than kRepeat_s later. If the motion
// breaks only limits of velocity or acceleration, the first problem names a velocity
// scaling factor that passes, close to the largest.
//
// Names are checked first:
// - each joint is known ("unknown-joint"), belongs to an arm ("joint-of-no-arm") and is named once
//   ("duplicate-joint");
// - every joint of each arm that moves is named ("missing-joint"). Gripper joints are optional.
//   Joints of several arms make one synchronous motion.
// Then the shape:
// - there are 2 to kWaypointsMax waypoints ("empty-trajectory", "too-few-points",
//   "too-many-points");
// - positions, velocities and accelerations have one finite number for each joint
//   ("no-velocities", "size-mismatch", "not-finite"). If only the first or last waypoint has no
//   velocities, they are 0, because the motion is at rest there;
// - accelerations are given in all waypoints or in none ("partial-accelerations");
// - times are given ("no-time") and begin with zero ("first-time-not-zero", "negative-time");
// - times ascend by kSegmentMin_s or more ("time-not-increasing"), up to kDurationMax_s
//   ("too-long").
// If names and shape are right, the motion:
// - first and last velocities are within kRestVelocity of zero ("not-at-rest");
// - positions are within [lower, upper], with a tolerance of kPositionTolerance at waypoints and of
//   kPositionOvershoot between them ("position-limit");
// - |velocity| and |acceleration| are up to the joint's limit times
//   (1 + cell.checking.limit_tolerance) ("velocity-limit", "acceleration-limit").
// Limits hold at every waypoint and, by bounds, at every instant between waypoints
// (core/trajectory/polynomial.h). The acceleration of a cubic jumps at waypoints: both one-sided
// values are checked, each as the end of its segment. Given accelerations need not be zero at the
// ends.
//
// The pointer of a problem leads into the request, for example "/points/14/velocities/3"; its value
// is the value found. A limit that is broken only between waypoints is reported at the later
// waypoint ("/points/14") with the worst value. A missing member is reported at the object that
// lacks it. The caller prepends its prefix ("/trajectory"). Returns all problems of the stages that
// were reached, at most kProblemsMax. Thread-safe. Takes about 0.1 ms for 100 waypoints of 7
// joints.
inline constexpr std::size_t kProblemsMax = 20;
[[nodiscard]] Result<TrajectoryPtr> validate(const TrajectoryRequest& request, const Cell& cell);

}  // namespace armloom
