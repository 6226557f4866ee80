#pragma once

#include <Eigen/Core>
#include <array>

#include "core/model/cell.h"
#include "core/trajectory/trajectory.h"

namespace armloom {

// A point of the phase plane of a motion: where on the path, and the rate r = ds/dt (1: as
// planned).
struct PathPoint {
  Duration progress;
  double rate;
};

// How fast the rate of progress along a trajectory q(s) may change. The joints' acceleration is
//   q'(s) s'' + q''(s) r^2
// with ' the derivative by trajectory time, so each joint's limit is an interval of s'' (Bobrow,
// Dubowsky and Gibson 1985). All joints of the trajectory count, also those of other arms: arms
// that share a synchronous motion then brake and continue in step. All s'' are in 1/s.
class RateLaw {
 public:
  // |s''| is never larger: where the path nearly rests, its limits say nothing.
  inline static constexpr double kRateChangeMax_1_s = 50.0;
  // A brake always makes this share of a joint's limit, even where the path itself uses it all up:
  // so it ends.
  inline static constexpr double kBrakeFloorShare = 0.02;

  explicit RateLaw(CellPtr cell) : cell_(std::move(cell)) {}
  void follow(TrajectoryPtr trajectory);

  // The strongest deceleration s'' < 0 for the stretch from `first` to `last`, within `share` of
  // the joints' brake limits at both of its ends; where no s'' is, the one that breaks them least.
  [[nodiscard]] double brake(PathPoint first, PathPoint last, double share = 1.0);
  // The strongest acceleration s'' >= 0 within the acceleration limits, on a tick of `period_s`.
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
  double floor_ = 0.0;              // smallest deceleration of a brake, > 0
  std::array<Sampled, 2> sampled_;  // the last two places that were asked for
  std::size_t older_ = 0;
};

}  // namespace armloom
