#pragma once

#include <vector>

#include "core/base/problem.h"
#include "core/trajectory/timing/joint_path.h"
#include "core/trajectory/timing/joint_rates.h"
#include "core/trajectory/validate.h"

namespace armloom {

// From where to go to when: times for a way of joints within the cell's limits of velocity,
// acceleration and jerk (without tolerance), at rest, acceleration included, at both ends.
//
// What comes out has waypoints with positions, velocities and accelerations, as `POST /jobs` takes
// them, and no limit is exceeded at any instant of the quintics between them; by bounds, as
// validate() (core/trajectory/validate.h), not by samples. Problems: those of validate() (a
// position outside its limits, a joint of the arm that is missing), of the motion that was made:
// pointers go into `request`. Throws std::invalid_argument where sizes do not fit, a way has no
// length, or a share is not in (0, 1]. Pure and thread-safe.
struct TimedMotion {
  TrajectoryRequest request;
  TrajectoryPtr trajectory;
};

struct TimingOptions {
  RateShares shares = {};
  // Soft motions cut corners of the path (soft_motion.h); no joint leaves it by more (rad or m).
  double off_path = 1e-3;
};

// Straight in joint space, all joints in step, by one jerk-limited profile: the fastest such motion
// (rest_to_rest.h). Takes 10 ms where it goes nowhere. Some 10 us.
[[nodiscard]] Result<TimedMotion> time_line(const Cell& cell, const std::vector<JointId>& joints,
                                            const Eigen::VectorXd& from, const Eigen::VectorXd& to,
                                            const TimingOptions& options = {});
// The same from point to point, at rest at each.
[[nodiscard]] Result<TimedMotion> time_lines(const Cell& cell, const std::vector<JointId>& joints,
                                             const std::vector<Eigen::VectorXd>& points,
                                             const TimingOptions& options = {});
// Along a path without a stop: the fastest way within velocities and accelerations (path_speed.h),
// softened within jerks (soft_motion.h) by a window of 2 a/j, at least kWindowMin_s; where that
// would leave the path by more than options.off_path, accelerations are lowered. A millisecond for
// a path through 100 points.
inline constexpr double kWindowMin_s = 0.004;
[[nodiscard]] Result<TimedMotion> time_path(const Cell& cell, const std::vector<JointId>& joints,
                                            const JointPath& path,
                                            const TimingOptions& options = {});

// The largest share of a limit that a motion uses at any instant of the quintics between its
// waypoints (positions, velocities, accelerations, ascending times), exactly but for velocities
// below the limit, which are bounded: 1 is the limit.
struct LimitShares {
  double velocity = 0.0;
  double acceleration = 0.0;
  double jerk = 0.0;
};
[[nodiscard]] LimitShares limit_shares(const std::vector<WaypointRequest>& points,
                                       const JointRates& rates);

}  // namespace armloom
