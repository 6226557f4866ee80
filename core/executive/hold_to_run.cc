#include "core/executive/hold_to_run.h"

#include <algorithm>

namespace armloom {

std::vector<std::string> HoldToRun::let_go(TimePoint now) {
  std::vector<std::string> over;
  for (auto lease = leases_.begin(); lease != leases_.end();) {
    if (lease->second > now) {
      ++lease;
      continue;
    }
    over.push_back(lease->first);
    lease = leases_.erase(lease);
  }
  return over;
}

TimePoint HoldToRun::next() const {
  TimePoint first = TimePoint::max();
  for (const auto& [job, until] : leases_) first = std::min(first, until);
  return first;
}

}  // namespace armloom
