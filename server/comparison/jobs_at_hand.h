#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/time.h"

namespace armloom {

// Jobs that clients submitted in this session, oldest first. If they exceed the bounds, the oldest
// jobs are dropped. Use on the server's thread.
class JobsAtHand {
 public:
  struct Job {
    std::string key;
    TimePoint submitted_at;
    std::shared_ptr<const std::string> body;  // body of POST /jobs; other threads may read it
  };
  struct Bounds {
    std::size_t jobs = 500;
    std::size_t bytes = std::size_t{16} << 20U;  // of bodies
  };
  explicit JobsAtHand(Bounds bounds) : bounds_(bounds) {}
  JobsAtHand() : JobsAtHand(Bounds{}) {}

  void note(Job job);

  // Result of since(): the jobs submitted at or after `from`, or all jobs if `from` is nullopt.
  // `whole`: there were no earlier jobs, so the first job found all arms at home.
  struct Taken {
    std::vector<Job> jobs;
    bool whole = true;
  };
  [[nodiscard]] Taken since(std::optional<TimePoint> from) const;

 private:
  Bounds bounds_;
  std::deque<Job> jobs_;
  std::size_t bytes_ = 0;
  bool some_are_gone_ = false;
};

}  // namespace armloom
