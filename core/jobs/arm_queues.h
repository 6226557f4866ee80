#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "core/jobs/job.h"

namespace armloom {

// The queues of the arms: of each its jobs that have not ended, first goes first; and the work that
// stands in each.
class ArmQueues {
 public:
  using Queue = std::deque<JobId>;
  explicit ArmQueues(std::size_t arms) : queues_(arms), work_(arms) {}

  [[nodiscard]] const Queue& operator[](ArmId arm) const { return queues_[arm.index()]; }
  [[nodiscard]] std::size_t size() const { return queues_.size(); }
  [[nodiscard]] auto begin() const { return queues_.begin(); }  // by ArmId
  [[nodiscard]] auto end() const { return queues_.end(); }

  [[nodiscard]] bool is_first(const Job& job) const;  // of all its arms
  // Its neighbours on that arm of its own; nothing: it is the first, or the last one.
  [[nodiscard]] std::optional<JobId> before(const Job& job, ArmId arm) const;
  [[nodiscard]] std::optional<JobId> behind(const Job& job, ArmId arm) const;

  // At the end of its arms, or before that one where it stands.
  void insert(const Job& job, std::optional<JobId> before);
  // With so many in front of it.
  void insert_at(const Job& job, std::size_t place);
  void erase(const Job& job);
  // These follow each other on the same arms: now in this order.
  void put_in_order(const Job& any_of_them, const std::vector<JobId>& jobs);

  // The time that its motion takes comes to, or from, the work of its arms. A job that could still
  // go on several arms counts as shared by them. Whatever changes that: first remove it, then add.
  void add_work(const Job& job);
  void remove_work(const Job& job);
  // By ArmId, of all jobs but these.
  [[nodiscard]] std::vector<Duration> work_but(const std::vector<const Job*>& in_front) const;

 private:
  std::vector<Queue> queues_;
  std::vector<Duration> work_;
};

}  // namespace armloom
