#pragma once

#include <vector>

#include "core/base/problem.h"
#include "core/trajectory/timing/joint_path.h"
#include "core/trajectory/timing/joint_rates.h"
#include "core/trajectory/validate.h"

namespace armloom {

// Time parameterization computes times for a path of joints, within the cell's velocity,
// acceleration and jerk limits (without tolerance). At both ends, velocity and acceleration are
// zero.
//
// The result has waypoints with positions, velocities and accelerations, as `POST /jobs` takes
// them. No limit is exceeded at any instant of the quintics between the waypoints. This is proven
// by bounds, as in validate() (core/trajectory/validate.h), not by samples. Problems are those of
// validate(), with pointers into the resulting `request`: a position outside its limits, a missing
// joint of the arm. Throws std::invalid_argument if sizes do not match, a path has no length, or a
// share is not in (0, 1]. Pure and thread-safe.
struct TimedMotion {
  TrajectoryRequest request;
  TrajectoryPtr trajectory;
};

struct TimingOptions {
  RateShares shares = {};
  // Maximum distance of a joint from the path after softening (soft_motion.h); rad or m.
  double off_path = 1e-3;
};

// Times a straight line in joint space, all joints in step, by the fastest jerk-limited profile
// (rest_to_rest.h). If `from` equals `to`, the motion lasts 10 ms. Computing it takes about 10 us.
[[nodiscard]] Result<TimedMotion> time_line(const Cell& cell, const std::vector<JointId>& joints,
                                            const Eigen::VectorXd& from, const Eigen::VectorXd& to,
                                            const TimingOptions& options = {});
// Times straight lines from point to point. The motion rests at each point.
[[nodiscard]] Result<TimedMotion> time_lines(const Cell& cell, const std::vector<JointId>& joints,
                                             const std::vector<Eigen::VectorXd>& points,
                                             const TimingOptions& options = {});
// Times a path without a stop. Computes the fastest speeds within velocity and acceleration limits
// (path_speed.h). Then softens the motion to keep the jerk limits (soft_motion.h), by a window of 2
// a/j, at least kWindowMin_s. Lowers accelerations if the softened motion would leave the path by
// more than options.off_path. Takes a millisecond for 100 points.
inline constexpr double kWindowMin_s = 0.004;
[[nodiscard]] Result<TimedMotion> time_path(const Cell& cell, const std::vector<JointId>& joints,
                                            const JointPath& path,
                                            const TimingOptions& options = {});

// Largest shares of the limits that a motion uses at any instant of the quintics between its
// waypoints; 1 is the limit. The waypoints have positions, velocities, accelerations and ascending
// times. The shares are exact, except that a velocity share below 1 is an upper bound.
struct LimitShares {
  double velocity = 0.0;
  double acceleration = 0.0;
  double jerk = 0.0;
};
[[nodiscard]] LimitShares limit_shares(const std::vector<WaypointRequest>& points,
                                       const JointRates& rates);

}  // namespace armloom
