#include "server/hub/recent_states.h"

namespace armloom {

void RecentStates::take(TimePoint time, const Configuration& q, Clock::time_point now) {
  if (now < next_) return;
  const bool is_in_step = now < next_ + kPeriod;  // else missed periods are skipped
  next_ = (is_in_step ? next_ : now) + kPeriod;
  frames_.push_back(std::make_shared<const Frame>(Frame{time, q}));
  if (frames_.size() > kFramesMax) frames_.pop_front();
}

}  // namespace armloom
