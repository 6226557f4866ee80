#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/base/time.h"

namespace armloom {

// Jobs that go on only as long as somebody says so again and again: moves by hand, behind a button
// that is held. Each has a lease; when that is over the job is to be cancelled. On the strand.
class HoldToRun {
 public:
  void hold(const std::string& job, TimePoint until) { leases_[job] = until; }
  // The jobs whose lease is over by `now`: they are forgotten here.
  [[nodiscard]] std::vector<std::string> let_go(TimePoint now);
  // When the next lease is over; TimePoint::max(): nobody holds anything.
  [[nodiscard]] TimePoint next() const;

 private:
  std::map<std::string, TimePoint> leases_;  // by the jobs' keys
};

}  // namespace armloom
