#pragma once

#include <algorithm>

#include "core/trajectory/braking_curve.h"
#include "core/trajectory/rate_law.h"

namespace armloom {

// Commanded progress of an arm on its path. The rate follows the speed override (0 to 1) within the
// rate law, and reaches zero at the authority.
class CommandedProgress {
 public:
  explicit CommandedProgress(CellPtr cell) : law_(std::move(cell)) {}

  // Starts at rest at `from`.
  void follow(TrajectoryPtr trajectory, Duration from, Duration authority);
  // Sets the authority. If a brake cannot end there any more, the authority is raised to where a
  // brake ends.
  void grant(Duration authority);
  // Sets the speed override: the rate that the arm takes, from 0 to 1, where its authority allows.
  void set_speed(double share) { speed_ = share; }
  void advance(Duration period, bool braking);
  // Returns the progress at which the arm would rest if it braked from the next tick on.
  [[nodiscard]] Duration stop_from_here();

  [[nodiscard]] Duration progress() const { return progress_; }
  [[nodiscard]] double rate() const { return rate_; }
  [[nodiscard]] Duration authority() const { return authority_; }
  [[nodiscard]] double speed() const { return speed_; }
  // Returns the largest progress that the arm may reach.
  [[nodiscard]] Duration end() const { return std::min(authority_, trajectory_->duration()); }

 private:
  struct Step {
    double rate;        // at the end of the tick
    double progress_s;  // progress made in the tick
  };
  [[nodiscard]] Step toward_speed(double period_s);
  [[nodiscard]] Step next_step(double period_s);
  [[nodiscard]] Step braked(Duration progress, double rate, double period_s);
  [[nodiscard]] Step below_curve(Step fastest, double period_s);
  void refresh_curve(Duration horizon);
  void compute_curve();

  RateLaw law_;
  BrakingCurve curve_;
  bool curve_stale_ = true;  // the authority has grown since; the curve is conservative
  TrajectoryPtr trajectory_;
  Duration progress_{};
  Duration authority_{};
  double rate_ = 0.0;
  double speed_ = 1.0;
};

}  // namespace armloom
