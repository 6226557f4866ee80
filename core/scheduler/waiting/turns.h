#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "core/deadlock/waits_for.h"
#include "core/jobs/state.h"

namespace armloom {

// Whose turn it is among the jobs that wait, as things stand: held jobs first, then the larger
// priority, where a job that others wait for is as urgent as the most urgent of them, then the
// earlier. A job that has waited for scheduling.aging since it was first in conflict, or first
// without a place, holds back every other one but those that have to go before it, unless what it
// waits for is an arm that no job moves, an object or a stop (README.md: how long can a job be
// overtaken). Refers to the state.
class Turns {
 public:
  explicit Turns(const State& state);

  [[nodiscard]] const State& state() const { return state_; }
  // The next that is to be judged: every gate is open for it.
  [[nodiscard]] std::optional<JobId> next() const;
  // The aged job that comes first.
  [[nodiscard]] std::optional<JobId> held_back_by(const Record& record) const;
  // Nobody looks for its first closed gate again.
  void has_found(JobId job, bool is_closed) { found_.emplace_back(job, is_closed); }

 private:
  // A job that has waited for longer than scheduling.aging, and all that have to go before it.
  struct Aged {
    JobId job;
    std::vector<JobId> goes_first;  // ascending
  };
  [[nodiscard]] std::vector<Aged> aged_jobs() const;  // the oldest first
  [[nodiscard]] std::map<JobId, int> urgencies() const;
  [[nodiscard]] bool is_closed(const Record& record) const;

  const State& state_;
  std::vector<Aged> aged_;  // that hold others back
  std::vector<std::pair<JobId, bool>> found_;
};

// Somebody at the head of an arm has waited for longer than scheduling.aging.
[[nodiscard]] bool any_is_aged(const State& state);

// Tells each job what it waits for: the first gate that is closed for it. Answers the turns as they
// are, which count until something changes.
Turns explain_waits(State& state);

}  // namespace armloom
