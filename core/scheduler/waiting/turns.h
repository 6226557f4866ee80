#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "core/deadlock/waits_for.h"
#include "core/jobs/transitions.h"

namespace armloom {

struct Urgency {
  JobId job;
  int priority;
};

// Returns effective priorities (priority inheritance): for each of `jobs`, the largest of its own
// priority and the priorities of all jobs that wait for it in `graph`, directly or through others.
// Jobs of the graph that are not in `jobs` only pass priorities on. O(n log n).
[[nodiscard]] std::map<JobId, int> effective_priorities(const WaitsFor& graph,
                                                        std::vector<Urgency> jobs);

// Decides whose turn it is: paused jobs first, then the larger effective priority
// (effective_priorities()), then the earlier job. A job is aged when it has waited for
// scheduling.aging since it was first in conflict or without a place. An aged job holds back other
// jobs (README.md, Aging). It does not hold back jobs that must precede it or earlier jobs with a
// larger priority. It holds back none while it waits for an arm that no job moves, for an object or
// for a stop. The state must outlive this object.
class Turns {
 public:
  explicit Turns(const State& state);

  [[nodiscard]] const State& state() const { return state_; }
  // Returns the next job to be checked: the first one, in the order above, without a blocking
  // condition (gates.h).
  [[nodiscard]] std::optional<JobId> next() const;
  // Returns the aged job that holds this job back; if there are several, the one that aged first.
  // nullopt if there is none.
  [[nodiscard]] std::optional<JobId> held_back_by(const Step& step) const;
  // Caches whether the job is blocked.
  void has_found(JobId job, bool is_closed) { found_.emplace_back(job, is_closed); }

 private:
  // An aged job, and all jobs that must precede it.
  struct Aged {
    JobId job;
    std::vector<JobId> goes_first;  // ascending
  };
  [[nodiscard]] std::vector<Aged> aged_jobs() const;  // the oldest first
  [[nodiscard]] std::map<JobId, int> urgencies() const;
  [[nodiscard]] bool is_closed(const Step& step) const;

  const State& state_;
  std::vector<Aged> aged_;  // those that hold others back
  std::vector<std::pair<JobId, bool>> found_;
};

// Returns an aged job that is the first of an arm; nullopt if there is none.
[[nodiscard]] std::optional<JobId> any_aged(const State& state);

// Updates the published waits of all jobs for which they may have changed, to the first blocking
// condition. Returns the turns, which are valid until the state changes.
Turns explain_waits(Transitions& state);

}  // namespace armloom
