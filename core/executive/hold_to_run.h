#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/base/time.h"

namespace armloom {

// Leases of jog motions (hold-to-run): a job is canceled when its lease is over, unless the client
// has renewed the lease before. Used on the strand.
class HoldToRun {
 public:
  void hold(const std::string& job, TimePoint until) { leases_[job] = until; }
  // Removes the leases that are over at `now`, and returns the keys of their jobs.
  [[nodiscard]] std::vector<std::string> let_go(TimePoint now);
  // Returns when the next lease is over; TimePoint::max() if there is none.
  [[nodiscard]] TimePoint next() const;

 private:
  std::map<std::string, TimePoint> leases_;  // by job key
};

}  // namespace armloom
