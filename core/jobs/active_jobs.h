#pragma once

#include <map>
#include <set>
#include <vector>

#include "core/jobs/step.h"

namespace armloom {

// The jobs that have not ended, and what is counted and listed of them. A range of their ids.
class ActiveJobs {
 public:
  [[nodiscard]] auto begin() const { return all_.begin(); }  // ascending
  [[nodiscard]] auto end() const { return all_.end(); }
  [[nodiscard]] std::size_t size() const { return all_.size(); }
  [[nodiscard]] bool contains(JobId job) const { return all_.contains(job); }
  // Returns the jobs whose state is no longer `queued`; few, ascending.
  [[nodiscard]] const std::vector<JobId>& past_queue() const { return past_queue_; }
  // Returns the queued jobs that could still run on other arms.
  [[nodiscard]] const std::set<JobId>& undecided() const { return undecided_; }
  [[nodiscard]] bool have_goals() const { return goals_ > 0; }
  // Returns true if all have the same priority.
  [[nodiscard]] bool are_as_urgent() const { return priorities_.size() <= 1; }

  void add(const Step& step);
  // The step has changed its phase, or its arm was decided.
  void follow(const Step& step);
  void change_priority(int before, int now);
  // Returns the jobs that named the ended job in `after`.
  [[nodiscard]] std::vector<JobId> end(const Step& step);

 private:
  std::set<JobId> all_;
  std::vector<JobId> past_queue_;
  std::set<JobId> undecided_;
  std::size_t goals_ = 0;
  std::map<JobId, std::vector<JobId>> followers_;  // jobs that name the key in Submit::after
  std::map<int, std::size_t> priorities_;          // number of jobs per priority
};

}  // namespace armloom
