#include "core/arm/commanded_progress.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/arm/arm_controller.h"

namespace armloom {

void CommandedProgress::follow(TrajectoryPtr trajectory, Duration from, Duration authority) {
  trajectory_ = std::move(trajectory);
  law_.follow(trajectory_);
  progress_ = from;
  authority_ = std::max(authority, from);
  rate_ = 0.0;
  compute_curve();
}

void CommandedProgress::grant(Duration authority) {
  if (authority < authority_ && authority < trajectory_->duration()) {
    authority_ = std::max(authority, stop_from_here());
    compute_curve();
    return;
  }
  curve_stale_ = curve_stale_ || authority != authority_;
  authority_ = authority;
}

Duration CommandedProgress::stop_from_here() {
  Duration stop = progress_;
  double rate = rate_;
  while (rate > 0.0 && stop < end()) {
    const Step step = braked(stop, rate, to_seconds(kControlPeriod));
    stop += from_seconds(step.progress_s);
    rate = step.rate;
  }
  return std::min(stop, end());
}

void CommandedProgress::compute_curve() {
  curve_.compute(law_, progress_, end());
  curve_stale_ = false;
}

void CommandedProgress::advance(Duration period, bool braking) {
  if (progress_ >= end()) {
    rate_ = 0.0;
    return;
  }
  if (!braking) refresh_curve(progress_ + period);
  const bool bound = authority_ < trajectory_->duration();
  if (rate_ == 0.0 && progress_ == Duration{} && !braking) {
    // The path itself starts at rest.
    rate_ = bound ? std::min(std::sqrt(curve_.rate_squared(0.0)), speed_) : speed_;
  }
  if (rate_ == 1.0 && speed_ == 1.0 && !braking &&
      (!bound || progress_ + period <= curve_.free_until())) {
    progress_ = std::min(progress_ + period, end());  // whole nanoseconds keep the planned duration
  } else {
    const double period_s = to_seconds(period);
    const Step step = braking ? braked(progress_, rate_, period_s) : next_step(period_s);
    rate_ = step.rate;
    progress_ = std::min(progress_ + from_seconds(step.progress_s), end());
  }
  if (progress_ == end()) rate_ = 0.0;
}

// Returns the step of a braking arm. A brake that ends within the tick covers only the distance up
// to rest.
CommandedProgress::Step CommandedProgress::braked(Duration progress, double rate, double period_s) {
  if (period_s <= 0.0) return {rate, 0.0};
  const Duration last = std::min(progress + from_seconds(rate * period_s), trajectory_->duration());
  const double change = law_.brake({progress, rate}, {last, rate});
  const double rate_after = rate + change * period_s;
  if (rate_after <= 0.0) return {0.0, rate * rate / (-2.0 * change)};
  return {rate_after, 0.5 * (rate + rate_after) * period_s};
}

// Returns the step that brings the rate nearest to the speed override within the limits.
CommandedProgress::Step CommandedProgress::toward_speed(double period_s) {
  if (rate_ > speed_) {
    const Step slower = braked(progress_, rate_, period_s);
    if (slower.rate >= speed_) return slower;
    const double mean = 0.5 * (rate_ + speed_);  // brakes less than it may
    return {speed_, mean * period_s};
  }
  if (rate_ == speed_ || period_s <= 0.0) return {rate_, rate_ * period_s};
  const double change = law_.rise({progress_, rate_}, period_s);
  const double rate_after = rate_ + change * period_s;
  if (rate_after <= speed_) return {rate_after, 0.5 * (rate_ + rate_after) * period_s};
  const double rising_s = (speed_ - rate_) / change;
  return {speed_, 0.5 * (rate_ + speed_) * rising_s + speed_ * (period_s - rising_s)};
}

CommandedProgress::Step CommandedProgress::next_step(double period_s) {
  const Step fastest = toward_speed(period_s);
  if (authority_ >= trajectory_->duration()) return fastest;
  return below_curve(fastest, period_s);
}

CommandedProgress::Step CommandedProgress::below_curve(Step fastest, double period_s) {
  const double here_s = to_seconds(progress_);
  const auto above = [&](double rate, double progress_s) {
    return rate * rate > curve_.rate_squared(here_s + progress_s);
  };
  if (!above(fastest.rate, fastest.progress_s)) return fastest;

  const double left_s = to_seconds(authority_) - here_s;
  if (left_s <= 0.5 * rate_ * period_s) return {0.0, left_s};  // rests within this tick
  const auto covered = [&](double rate) { return 0.5 * (rate_ + rate) * period_s; };
  double low = 0.0;  // the curve falls: one crossing
  double high = fastest.rate;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (above(middle, covered(middle)) ? high : low) = middle;
  }
  const Step strongest = braked(progress_, rate_, period_s);
  return strongest.rate > low ? strongest : Step{low, covered(low)};
}

void CommandedProgress::refresh_curve(Duration horizon) {
  if (!curve_stale_ || authority_ >= trajectory_->duration()) return;
  if (rate_ > 0.0 && horizon <= curve_.free_until()) return;
  compute_curve();
}

}  // namespace armloom
