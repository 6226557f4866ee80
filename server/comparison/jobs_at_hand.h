#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/time.h"

namespace armloom {

// The jobs that clients submitted in this run of the server, as they came, oldest first: so many
// and so large at most, the oldest go first. On the server's thread.
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

  // Those since `from`, all of them without one. `whole`: nothing came before them, so that the
  // arms were at home when the first one did.
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
