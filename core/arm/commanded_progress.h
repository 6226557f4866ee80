#pragma once

#include <algorithm>

#include "core/arm/braking_curve.h"
#include "core/arm/rate_law.h"

namespace armloom {

// How far along its path an arm is told to be: it advances at a rate from 0 to 1, which rises and
// falls as fast as the rate law lets it, and comes to rest where the authority ends.
class CommandedProgress {
 public:
  explicit CommandedProgress(CellPtr cell) : law_(std::move(cell)) {}

  // Begins at rest at `from`.
  void follow(TrajectoryPtr trajectory, Duration from, Duration authority);
  // Authority that comes too late to stop for is raised to where a brake ends.
  void grant(Duration authority);
  void advance(Duration period, bool braking);

  [[nodiscard]] Duration progress() const { return progress_; }
  [[nodiscard]] double rate() const { return rate_; }
  // It goes no farther.
  [[nodiscard]] Duration end() const { return std::min(authority_, trajectory_->duration()); }

 private:
  // What the rate law makes of one tick.
  struct Step {
    double rate;        // at the end of the tick
    double progress_s;  // ground covered in it
  };
  [[nodiscard]] Step next_step(double period_s);
  [[nodiscard]] Step braked(Duration progress, double rate, double period_s);
  [[nodiscard]] Step below_curve(Step fastest, double period_s);
  void refresh_curve(Duration horizon);
  void compute_curve();

  RateLaw law_;
  BrakingCurve curve_;
  bool curve_stale_ = true;  // the authority has grown since; the curve is still on the safe side
  TrajectoryPtr trajectory_;
  Duration progress_{};
  Duration authority_{};
  double rate_ = 0.0;
};

}  // namespace armloom
