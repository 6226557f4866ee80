#include "core/precedence/precedence.h"

#include <algorithm>
#include <utility>

namespace armloom {
namespace {

ConflictRegion turned(ConflictRegion region) {
  for (ProgressBox& box : region.boxes) box = turned_around(box);
  region.proximity = turned_around(std::move(region.proximity));
  std::swap(region.time_a, region.time_b);
  return region;
}

}  // namespace

Precedence::Precedence(StepId a, StepId b, const ConflictRegion& region, bool a_first,
                       bool waits_at_start, double pace_ratio)
    : first_(a_first ? a : b),
      second_(a_first ? b : a),
      waits_at_start_(waits_at_start),
      region_(a_first ? region : turned(region)) {
  std::vector<ProgressBox> boxes = region_.boxes;
  std::ranges::sort(boxes, std::greater<>(), &ProgressBox::to_a);
  Duration begins{};  // with `first` so far, `second` passes without a stop
  // Goes back from the last box: boxes ahead of `first` hold `second` at their nearest edge.
  for (const ProgressBox& box : boxes) {
    const Duration limit = std::max(Duration{}, box.from_b - kShortOf);
    begins = std::max(begins, box.to_a - paced(limit, pace_ratio));
    if (!steps_.empty() && limit >= steps_.back().limit) continue;
    if (!steps_.empty() && box.to_a == steps_.back().until) {
      steps_.back().limit = limit;
    } else {
      steps_.push_back({box.to_a, limit});
    }
  }
  std::ranges::reverse(steps_);
  if (!waits_at_start || steps_.empty()) return;
  if (begins <= Duration{}) return;
  std::erase_if(steps_, [begins](const Step& step) { return step.until <= begins; });
  steps_.insert(steps_.begin(), {begins, Duration{}});
}

std::optional<Duration> Precedence::limit(Duration progress_of_first) const {
  const auto step = std::ranges::upper_bound(steps_, progress_of_first, {}, &Step::until);
  return step == steps_.end() ? std::nullopt : std::optional(step->limit);
}

}  // namespace armloom
