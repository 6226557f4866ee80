#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "core/jobs/job.h"

namespace armloom {

// The arm queues: for each arm its jobs that have not ended, in running order, and the work in the
// queue.
class ArmQueues {
 public:
  using Queue = std::deque<JobId>;
  explicit ArmQueues(std::size_t arms) : queues_(arms), work_(arms) {}

  [[nodiscard]] const Queue& operator[](ArmId arm) const { return queues_[arm.index()]; }
  [[nodiscard]] std::size_t size() const { return queues_.size(); }
  [[nodiscard]] auto begin() const { return queues_.begin(); }  // by ArmId
  [[nodiscard]] auto end() const { return queues_.end(); }

  [[nodiscard]] bool is_first(const Job& job) const;  // of all its arms
  // Return the adjacent jobs in that arm's queue; nullopt at the front or the end of the queue.
  [[nodiscard]] std::optional<JobId> before(const Job& job, ArmId arm) const;
  [[nodiscard]] std::optional<JobId> behind(const Job& job, ArmId arm) const;

  // Inserts the job at the end of its arms' queues, or before `before` in the queues that contain
  // it.
  void insert(const Job& job, std::optional<JobId> before);
  // Inserts the job behind the first `place` jobs of its arms' queues.
  void insert_at(const Job& job, std::size_t place);
  void erase(const Job& job);
  // Reorders jobs that occupy consecutive places on the same arms.
  void put_in_order(const Job& any_of_them, const std::vector<JobId>& jobs);

  // Add or remove the job's duration as work of its arms. A job that may still run on several arms
  // is shared equally between them. To change a job, remove its work first and add it again after.
  void add_work(const Job& job);
  void remove_work(const Job& job);
  // Returns the work of all jobs except `in_front`, by ArmId.
  [[nodiscard]] std::vector<Duration> work_but(const std::vector<const Job*>& in_front) const;

 private:
  std::vector<Queue> queues_;
  std::vector<Duration> work_;
};

}  // namespace armloom
