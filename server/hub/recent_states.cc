#include "server/hub/recent_states.h"

#include <algorithm>

namespace armloom {

void RecentStates::take(TimePoint time, const Configuration& q, Clock::time_point now) {
  if (now < next_) return;
  next_ = std::max(next_ + kPeriod, now);
  frames_.push_back(std::make_shared<const Frame>(Frame{time, q}));
  if (frames_.size() > kFramesMax) frames_.pop_front();
}

}  // namespace armloom
