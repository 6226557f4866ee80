#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/base/ids.h"
#include "core/base/problem.h"
#include "core/model/cell.h"
#include "core/trajectory/trajectory.h"

namespace armloom {

// Minimum duration of a line, also if its length is zero.
inline constexpr Duration kLineMin = std::chrono::milliseconds(10);

// Returns the straight line in joint space from `from` to `to`, at rest (velocity and acceleration
// zero) at both ends, all joints in step: q(t) = from + s(t/T) (to - from) with the quintic
//   s(x) = 10 x^3 - 15 x^4 + 6 x^5   (minimum jerk: Flash and Hogan 1985).
// Its derivatives peak at 15/8 (x = 1/2), 10/sqrt(3) (x = (3 - sqrt 3)/6) and 60 (x = 0). T is the
// least duration that keeps each joint's velocity, acceleration and jerk limits, without tolerance,
// divided by the speed f (default: the cell's velocity_scaling_factor):
//   T = max over joints of  15/8 d/v_max,  sqrt(10/sqrt(3) d/a_max),  cbrt(60 d/j_max),  over f.
// rad or m; throws std::invalid_argument unless `from` and `to` have one row for each joint.
// Problems are those of validate() (core/trajectory/validate.h): a position outside its limits, a
// missing joint of the arm. Pure and thread-safe.
[[nodiscard]] Result<TrajectoryPtr> joint_line(const Cell& cell, const std::vector<JointId>& joints,
                                               const Eigen::VectorXd& from,
                                               const Eigen::VectorXd& to,
                                               std::optional<double> speed = {});
// Returns joint_line(), or a rest at `to` if `from` is outside the limits. Returns null if `to` is
// outside, too.
[[nodiscard]] TrajectoryPtr line_or_stay(const Cell& cell, const std::vector<JointId>& joints,
                                         const Eigen::VectorXd& from, const Eigen::VectorXd& to,
                                         std::optional<double> speed = {});

// Returns the trajectory reversed in time: its position at t is that of `trajectory` at
// (duration - t). The velocity is negated and the acceleration is the same, so all limits that
// `trajectory` keeps still hold. Begins exactly at trajectory.goal() and ends at trajectory.start()
// up to rounding (1e-12).
[[nodiscard]] TrajectoryPtr retraced(const Trajectory& trajectory);

}  // namespace armloom
