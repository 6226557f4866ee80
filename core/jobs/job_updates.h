#pragma once

#include <set>
#include <utility>

#include "core/base/ids.h"

namespace armloom {

// The jobs whose published view (JobChanged), or whose wait explanation, is out of date.
class JobUpdates {
 public:
  void publish(JobId job) { changed_.insert(job); }
  void explain(JobId job) { unexplained_.insert(job); }
  void end(JobId job) { unexplained_.erase(job); }
  [[nodiscard]] bool has_changed() const { return !changed_.empty(); }
  // Return the jobs marked since the last call.
  [[nodiscard]] std::set<JobId> take_changed() { return std::exchange(changed_, {}); }
  [[nodiscard]] std::set<JobId> take_unexplained() { return std::exchange(unexplained_, {}); }

 private:
  std::set<JobId> changed_, unexplained_;
};

}  // namespace armloom
