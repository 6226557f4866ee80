#pragma once

#include <Eigen/Core>
#include <array>

#include "core/model/cell.h"
#include "core/trajectory/trajectory.h"

namespace armloom {

// A point of a motion's phase plane. The rate is r = ds/dt: trajectory time per time; 1 as planned.
struct PathPoint {
  Duration progress;
  double rate;
};

// Limits the change of rate along a trajectory q(s). The joints' acceleration is
//   q'(s) s'' + q''(s) r^2
// with ' the derivative by trajectory time, so each joint limits s'' to an interval (Bobrow,
// Dubowsky and Gibson 1985). Includes all joints of the trajectory, so that the arms of a
// synchronous motion keep in step. All s'' are in 1/s.
class RateLaw {
 public:
  // Bound on |s''|, because the joint limits permit any s'' where the path almost rests.
  inline static constexpr double kRateChangeMax_1_s = 50.0;
  // A brake uses at least this share of the joint limits, even if the path itself needs all of
  // them. So every brake ends.
  inline static constexpr double kBrakeFloorShare = 0.02;

  explicit RateLaw(CellPtr cell) : cell_(std::move(cell)) {}
  void follow(TrajectoryPtr trajectory);

  // Returns the strongest deceleration s'' < 0 from `first` to `last` within `share` of the brake
  // limits at both ends, or, if there is no such s'', the s'' that violates the limits least.
  [[nodiscard]] double brake(PathPoint first, PathPoint last, double share = 1.0);
  // Returns the strongest acceleration s'' >= 0 within the limits for a tick of `period_s`.
  [[nodiscard]] double rise(PathPoint first, double period_s);

 private:
  struct Interval {
    double lowest;
    double highest;
  };
  struct Sampled {
    Duration progress{-1};
    JointState state;
  };
  [[nodiscard]] const JointState& sample(Duration progress);
  [[nodiscard]] static Interval within(const JointState& state, double rate,
                                       const Eigen::VectorXd& limit, double share);
  [[nodiscard]] double least_breach(const JointState& first, double rate_first,
                                    const JointState& last, double rate_last) const;

  CellPtr cell_;
  TrajectoryPtr trajectory_;
  Eigen::VectorXd acceleration_;  // limits of the trajectory's joints, > 0
  Eigen::VectorXd brake_;
  double floor_ = 0.0;              // lower bound of the deceleration of any brake, > 0
  std::array<Sampled, 2> sampled_;  // the last two points requested
  std::size_t older_ = 0;
};

}  // namespace armloom
