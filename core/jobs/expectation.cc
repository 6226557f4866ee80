#include "core/jobs/expectation.h"

#include <algorithm>

namespace armloom {
namespace {

// Tolerated deviation: lag, starts between two ticks, braking for a pause.
constexpr Duration kOffAtMost = std::chrono::milliseconds(400);

}  // namespace

Duration Expectation::progress_at(const Way& way, Duration time) {
  const auto& stages = way.stages;
  const auto next = std::ranges::upper_bound(stages, time, {}, &Prediction::Stage::time);
  if (next == stages.begin()) return stages.front().progress;
  const Prediction::Stage& from = *(next - 1);
  if (next == stages.end()) return from.progress;
  return std::min(from.progress + paced(time - from.time, 1.0 / way.pace), next->progress);
}

void Expectation::renew(const std::vector<CoordinatedMotion>& motions, const Prediction& prediction,
                        TimePoint now) {
  expected_.clear();
  for (std::size_t m = 0; m < motions.size(); ++m) {
    const auto stages = prediction.stages(m);
    expected_[motions[m].step] = {{stages.begin(), stages.end()}, motions[m].outlook.pace};
  }
  at_ = now;
  is_spoilt_ = false;
}

bool Expectation::is_missed(const std::vector<CoordinatedMotion>& motions, TimePoint now) const {
  if (is_spoilt_) return !motions.empty();
  return std::ranges::any_of(motions, [&](const CoordinatedMotion& motion) {
    const auto way = expected_.find(motion.step);
    if (way == expected_.end() || way->second.stages.empty()) return false;
    const Duration off = motion.progress - progress_at(way->second, now - at_);
    return off > kOffAtMost || off < -kOffAtMost;
  });
}

}  // namespace armloom
