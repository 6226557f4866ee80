#include "core/scheduler/horizon/expectation.h"

#include <algorithm>

namespace armloom {
namespace {

// So far off its expectation a motion may be: lag, starts between two ticks, braking for a pause.
constexpr Duration kOffAtMost = std::chrono::milliseconds(400);

Duration progress_at(const std::vector<Prediction::Stage>& stages, Duration time) {
  const auto next = std::ranges::upper_bound(stages, time, {}, &Prediction::Stage::time);
  if (next == stages.begin()) return stages.front().progress;
  const Prediction::Stage& from = *(next - 1);
  if (next == stages.end()) return from.progress;
  return std::min(from.progress + (time - from.time), next->progress);
}

}  // namespace

void Expectation::renew(const std::vector<CoordinatedMotion>& motions, const Prediction& prediction,
                        TimePoint now) {
  stages_.clear();
  for (std::size_t m = 0; m < motions.size(); ++m) {
    const auto stages = prediction.stages(m);
    stages_[motions[m].job].assign(stages.begin(), stages.end());
  }
  at_ = now;
  is_spoilt_ = false;
}

bool Expectation::is_missed(const std::vector<CoordinatedMotion>& motions, TimePoint now) const {
  if (is_spoilt_) return !motions.empty();
  return std::ranges::any_of(motions, [&](const CoordinatedMotion& motion) {
    const auto stages = stages_.find(motion.job);
    if (stages == stages_.end() || stages->second.empty()) return false;
    const Duration off = motion.progress - progress_at(stages->second, now - at_);
    return off > kOffAtMost || off < -kOffAtMost;
  });
}

}  // namespace armloom
