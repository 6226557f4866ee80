#include "core/monitor/earliest_rest.h"

#include <algorithm>
#include <cmath>

#include "core/trajectory/stopping_reach.h"

namespace armloom {
namespace {

constexpr double kStep_s = 2e-3;
// Allowance for the steps: 1 ms of motion.
constexpr Duration kSlack = std::chrono::milliseconds(1);

}  // namespace

void EarliestRest::observe(const ArmObservation& now) {
  const std::optional<Duration> elapsed = since(last_at_, now.reported);
  if (now.motion != motion_) {
    motion_ = now.motion;
    reach_ = from_seconds(stopping_reach_s(*cell_, *motion_));
    law_.follow(motion_);
    before_ = now.commanded;
    rate_ = 0.0;
  } else if (elapsed) {
    before_ = std::min(last_, now.commanded);
    const double rate = to_seconds(now.commanded - last_) / to_seconds(*elapsed);
    rate_ = std::clamp(rate / std::sqrt(now.brake), 0.0, 1.0);
  }
  last_ = now.commanded;
  last_at_ = now.reported;
}

// The arm had the mean rate somewhere between the two reports: at the first one, it could rest
// earlier than from there.
Duration EarliestRest::beyond(const ArmObservation& now) {
  const Duration reached = std::max(now.measured, now.commanded);
  if (now.authority >= motion_->duration()) return now.measured;
  if (reached > now.authority) return reached;
  if (before_ + from_seconds(rate_ * rate_ * to_seconds(reach_)) <= now.authority) {
    return now.measured;
  }
  Duration at = before_;
  double rate = rate_;
  while (rate > 0.0 && at < motion_->duration()) {
    const Duration ahead = std::min(at + from_seconds(rate * kStep_s), motion_->duration());
    const double change = law_.brake({at, rate}, {ahead, rate});
    const double after = rate + change * kStep_s;
    at +=
        from_seconds(after > 0.0 ? 0.5 * (rate + after) * kStep_s : rate * rate / (-2.0 * change));
    rate = std::max(0.0, after);
  }
  return at > now.authority + kSlack ? std::min(at, motion_->duration()) : now.measured;
}

}  // namespace armloom
