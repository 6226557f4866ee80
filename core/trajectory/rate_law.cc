#include "core/trajectory/rate_law.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace armloom {
namespace {

// A slower joint does not constrain s''.
constexpr double kStandingSpeed = 1e-9;

double worst_share(const JointState& state, double rate, const Eigen::VectorXd& limit,
                   double change) {
  return ((state.velocity * change + state.acceleration * (rate * rate)).array().abs() /
          limit.array())
      .maxCoeff();
}

}  // namespace

void RateLaw::follow(TrajectoryPtr trajectory) {
  trajectory_ = std::move(trajectory);
  const auto size = static_cast<Eigen::Index>(trajectory_->joints().size());
  acceleration_.resize(size);
  brake_.resize(size);
  double slowest = std::numeric_limits<double>::infinity();
  for (Eigen::Index j = 0; j < size; ++j) {
    const Joint& joint = cell_->joint(trajectory_->joints()[static_cast<std::size_t>(j)]);
    acceleration_[j] = joint.acceleration_max;
    brake_[j] = joint.brake;
    slowest = std::min(slowest, joint.brake / joint.velocity_max);
  }
  floor_ = std::min(kBrakeFloorShare * slowest, kRateChangeMax_1_s);
  for (Sampled& sampled : sampled_) {
    sampled.progress = Duration{-1};
    trajectory_->sample(Duration{}, sampled.state);  // allocates before the first tick
  }
}

const JointState& RateLaw::sample(Duration progress) {
  for (std::size_t i = 0; i < sampled_.size(); ++i) {
    if (sampled_[i].progress == progress) {
      older_ = 1 - i;
      return sampled_[i].state;
    }
  }
  Sampled& slot = sampled_[older_];
  older_ = 1 - older_;
  trajectory_->sample(progress, slot.state);
  slot.progress = progress;
  return slot.state;
}

RateLaw::Interval RateLaw::within(const JointState& state, double rate,
                                  const Eigen::VectorXd& limit, double share) {
  Interval interval{-std::numeric_limits<double>::infinity(),
                    std::numeric_limits<double>::infinity()};
  for (Eigen::Index j = 0; j < limit.size(); ++j) {
    const double speed = std::abs(state.velocity[j]);
    if (speed < kStandingSpeed) continue;
    // Along the joint's own direction of travel: |speed s'' + pull| <= limit.
    const double pull = std::copysign(1.0, state.velocity[j]) * state.acceleration[j] * rate * rate;
    interval.lowest = std::max(interval.lowest, (-share * limit[j] - pull) / speed);
    interval.highest = std::min(interval.highest, (share * limit[j] - pull) / speed);
  }
  return interval;
}

double RateLaw::brake(PathPoint first, PathPoint last, double share) {
  const JointState& at_first = sample(first.progress);
  const JointState& at_last = sample(last.progress);
  const Interval a = within(at_first, first.rate, brake_, share);
  const Interval b = within(at_last, last.rate, brake_, share);
  const double lowest = std::max(a.lowest, b.lowest);
  if (lowest > std::min(a.highest, b.highest)) {
    return least_breach(at_first, first.rate, at_last, last.rate);
  }
  return std::clamp(lowest, -kRateChangeMax_1_s, -floor_);
}

double RateLaw::least_breach(const JointState& first, double rate_first, const JointState& last,
                             double rate_last) const {
  const auto breach = [&](double change) {
    return std::max(worst_share(first, rate_first, brake_, change),
                    worst_share(last, rate_last, brake_, change));
  };
  // The largest absolute value of linear functions is convex, so a ternary search finds its
  // minimum.
  double low = -kRateChangeMax_1_s;
  double high = -floor_;
  for (int i = 0; i < 40; ++i) {
    const double third = (high - low) / 3.0;
    if (breach(low + third) < breach(high - third)) {
      high -= third;
    } else {
      low += third;
    }
  }
  return high;
}

double RateLaw::rise(PathPoint first, double period_s) {
  const Interval a = within(sample(first.progress), first.rate, acceleration_, 1.0);
  const double begin = std::clamp(a.highest, 0.0, kRateChangeMax_1_s);
  const double rate_last = std::min(1.0, first.rate + begin * period_s);
  const Duration last =
      std::min(first.progress + from_seconds(rate_last * period_s), trajectory_->duration());
  const Interval b = within(sample(last), rate_last, acceleration_, 1.0);
  return std::clamp(b.highest, 0.0, begin);
}

}  // namespace armloom
