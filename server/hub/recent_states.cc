#include "server/hub/recent_states.h"

#include <algorithm>
#include <utility>

namespace armloom {

void RecentStates::take(TimePoint time, const Configuration& q, Clock::time_point now) {
  if (now < next_) return;
  const bool is_in_step = now < next_ + kPeriod;  // else missed periods are skipped
  next_ = (is_in_step ? next_ : now) + kPeriod;
  frames_.push_back(std::make_shared<const Frame>(Frame{time, q}));
  if (frames_.size() > kFramesMax) frames_.pop_front();
  for (Waiting& one : std::exchange(waiting_, {})) {
    auto later = later_than(one.after);
    if (later.empty() && now < one.deadline) {
      waiting_.push_back(std::move(one));
    } else {
      one.then(std::move(later));
    }
  }
}

void RecentStates::when_later(TimePoint after, Clock::time_point deadline, Then then) {
  auto later = later_than(after);
  if (later.empty()) {
    waiting_.push_back({after, deadline, std::move(then)});
  } else {
    then(std::move(later));
  }
}

std::vector<RecentStates::FramePtr> RecentStates::later_than(TimePoint after) const {
  const auto first = std::ranges::upper_bound(frames_, after, {},
                                              [](const FramePtr& frame) { return frame->time; });
  return {first, frames_.end()};
}

}  // namespace armloom
