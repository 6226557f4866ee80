#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/base/ids.h"
#include "core/base/problem.h"
#include "core/model/cell.h"
#include "core/trajectory/trajectory.h"

namespace armloom {

// No line is shorter than this: also one that goes nowhere takes time.
inline constexpr Duration kLineMin = std::chrono::milliseconds(10);

// The straight line in joint space from `from` to `to`, at rest (velocity and acceleration zero) at
// both ends, all joints in step: q(t) = from + s(t/T) (to - from) with the quintic
//   s(x) = 10 x^3 - 15 x^4 + 6 x^5   (minimum jerk: Flash and Hogan 1985).
// Its derivatives peak at 15/8 (x = 1/2), 10/sqrt(3) (x = (3 - sqrt 3)/6) and 60 (x = 0), so that T
// is the least duration for which each joint keeps its velocity, acceleration and jerk limits as
// the cell gives them, without tolerance, stretched by the cell's velocity_scaling_factor f:
//   T = max over joints of  15/8 d/v_max,  sqrt(10/sqrt(3) d/a_max),  cbrt(60 d/j_max),  over f.
// rad or m; `from` and `to` have one row for each of `joints` (throws std::invalid_argument).
// Problems: as validate() (core/trajectory/validate.h), through which the line goes: a position
// outside its limits, a joint of the arm that is missing. Pure and thread-safe.
[[nodiscard]] Result<TrajectoryPtr> joint_line(const Cell& cell, const std::vector<JointId>& joints,
                                               const Eigen::VectorXd& from,
                                               const Eigen::VectorXd& to);
// The same; where it sets out outside the limits, staying at `to`. Null: that is outside, too.
[[nodiscard]] TrajectoryPtr line_or_stay(const Cell& cell, const std::vector<JointId>& joints,
                                         const Eigen::VectorXd& from, const Eigen::VectorXd& to);

// The same path backwards with the same times: at t it is where `trajectory` is at duration - t,
// with the velocity negated and the acceleration kept. So it keeps every limit that `trajectory`
// keeps. It begins exactly at trajectory.goal(); its own goal is trajectory.start() but for
// rounding (1e-12).
[[nodiscard]] TrajectoryPtr retraced(const Trajectory& trajectory);

}  // namespace armloom
