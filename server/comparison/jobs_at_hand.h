#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/time.h"

namespace armloom {

// Jobs that clients submitted in this session, oldest first. Beyond the bounds, the oldest are
// dropped. Use on the server's thread.
class JobsAtHand {
 public:
  struct Job {
    std::string key;
    TimePoint submitted_at;
    std::shared_ptr<const std::string> body;  // of POST /jobs; shared by threads
  };
  struct Bounds {
    std::size_t jobs = 500;
    std::size_t bytes = std::size_t{16} << 20U;  // of bodies
  };
  explicit JobsAtHand(Bounds bounds) : bounds_(bounds) {}
  JobsAtHand() : JobsAtHand(Bounds{}) {}

  void note(Job job);

  // The jobs since `from`, or all without `from`. `whole`: there were no earlier jobs, so the first
  // job found all arms at home.
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
