#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "core/jobs/step.h"

namespace armloom {

// The arm queues: for each arm the steps of its jobs that have not ended, in running order, and the
// sum of their durations (work).
class ArmQueues {
 public:
  using Queue = std::deque<StepId>;
  explicit ArmQueues(std::size_t arms) : queues_(arms), work_(arms) {}

  [[nodiscard]] const Queue& operator[](ArmId arm) const { return queues_[arm.index()]; }
  [[nodiscard]] std::size_t size() const { return queues_.size(); }
  [[nodiscard]] auto begin() const { return queues_.begin(); }  // by ArmId
  [[nodiscard]] auto end() const { return queues_.end(); }

  [[nodiscard]] bool is_first(const Step& step) const;  // in the queues of all its arms
  // Return the neighbor in that arm's queue, if any.
  [[nodiscard]] std::optional<StepId> before(const Step& step, ArmId arm) const;
  [[nodiscard]] std::optional<StepId> behind(const Step& step, ArmId arm) const;

  // Inserts the job at the end of its arms' queues, or before the step `before` in queues that
  // contain it.
  void insert(const Step& step, std::optional<StepId> before);
  void insert_at(const Step& step, std::size_t place);
  void erase(const Step& step);
  // Puts these steps, which occupy consecutive places on the same arms, into the given order.
  void put_in_order(const Step& any_of_them, const std::vector<StepId>& steps);

  // Add or remove the job's duration as work. A job with several candidate arms is shared equally
  // between them. To change a job, remove its work first and add it again.
  void add_work(const Step& step);
  void remove_work(const Step& step);
  // Returns the work of each arm, by ArmId, without these jobs.
  [[nodiscard]] std::vector<Duration> work_but(const std::vector<const Step*>& in_front) const;

 private:
  std::vector<Queue> queues_;
  std::vector<Duration> work_;
};

}  // namespace armloom
