#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/jobs/arm_queues.h"
#include "core/jobs/step.h"

namespace armloom {

// Checks that job ids grow, from `first` on. Smaller ids belong to jobs of earlier sessions. These
// may arrive at any time, and must grow among themselves.
class JobIds {
 public:
  explicit JobIds(JobId first) : first_(first.value()), last_(first_ - 1) {}
  // Throws std::invalid_argument if the id does not grow.
  void take(JobId id);
  [[nodiscard]] JobId next() const { return JobId{last_ + 1}; }

 private:
  std::uint64_t first_, last_;
  std::uint64_t last_former_ = 0;
};

// All jobs and their places in the arm queues. Records which published views are out of date.
class JobBook {
 public:
  JobBook(std::size_t arms, JobId first) : ids_(first), queues_(arms) {}

  // Adds a job at the end of its arms' queues, or before Errand::before in the queues that contain
  // it. Throws like JobIds::take().
  Step& add(Step step);
  [[nodiscard]] JobId next_id() const { return ids_.next(); }
  void forget(JobId job);

  [[nodiscard]] bool is_active(JobId job) const { return active_.contains(job); }
  [[nodiscard]] Step* find(StepId step);
  [[nodiscard]] const Step* find(StepId step) const;
  [[nodiscard]] Step& at(StepId step) { return steps_.at(step); }
  [[nodiscard]] const Step& at(StepId step) const { return steps_.at(step); }
  // Return the only step of the job.
  [[nodiscard]] Step* find(JobId job) { return find(only_step(job)); }
  [[nodiscard]] const Step* find(JobId job) const { return find(only_step(job)); }
  [[nodiscard]] Step& at(JobId job) { return at(only_step(job)); }
  [[nodiscard]] const Step& at(JobId job) const { return at(only_step(job)); }
  // Returns the job, to be changed. Copies of this book keep the job as it was.
  [[nodiscard]] Job& change(Step& step);
  // Return the jobs that have not ended: all, or only those whose state is no longer `queued`.
  // Ascending ids.
  [[nodiscard]] const std::set<JobId>& active() const { return active_; }
  [[nodiscard]] const std::vector<JobId>& past_queue() const { return past_queue_; }
  [[nodiscard]] const ArmQueues& queues() const { return queues_; }
  // Reorders waiting jobs that occupy consecutive places on the same arms.
  void put_in_order(const std::vector<JobId>& jobs);
  // Moves a waiting job to another arm, at position `place` of that arm's queue.
  void take(Step& step, TrajectoryPtr trajectory, WaitingLeg leg, std::size_t place);
  // Sets the planned or a new path. Precondition: the job waits in the queue.
  void set_motion(Step& step, TrajectoryPtr trajectory, WaitingLeg leg);
  // Precondition: the job has not ended.
  void set_priority(Step& step, int priority);
  // Replaces one of the job's alternatives. If the job has this one now, its motion changes too.
  void set_alternative(Step& step, std::size_t which, TrajectoryPtr trajectory, WaitingLeg leg);
  // Assigns the job to its present arm for good. Precondition: the job is waiting.
  void decide_arm(Step& step);
  // Sets JobGoal::is_planned. Returns true if it was different.
  bool set_planned(Step& step, bool is_planned);
  // The admitted motion must be checked again.
  void put_in_question(Step& step);
  [[nodiscard]] bool has_goals() const { return goals_ > 0; }
  // Returns the queued jobs that could still run on other arms.
  [[nodiscard]] const std::set<JobId>& undecided() const { return undecided_; }
  // The jobs whose replanning has begun. A reader removes those that are no longer replanned.
  [[nodiscard]] std::set<JobId>& being_replanned() { return being_replanned_; }
  // Returns true if all active jobs have the same priority.
  [[nodiscard]] bool all_as_urgent() const { return priorities_.size() <= 1; }

  // Throws std::logic_error for transitions that are not in the table of step.h.
  void enter(Step& step, StepPhase phase);
  // Moves the job to Ended and out of the queues. Returns the active jobs that named it in `after`.
  [[nodiscard]] std::vector<JobId> end(Step& step, Ended how);
  void set_waits(Step& step, std::span<const Wait> waits);
  void set_wait(Step& step, const Wait& only) { set_waits(step, {&only, 1}); }

  // Grows with every change that makes an open answer stale: of a phase (not when a motion is
  // dispatched), of a path that can be checked, of the candidate arms, of a priority, and when
  // a motion must be checked again.
  [[nodiscard]] Version changes() const { return changes_; }

  // Mark a job whose published view or wait explanation is out of date.
  void changed(const Step& step) { news_.changed.insert(step.id.job); }
  void explain(const Step& step) { news_.unexplained.insert(step.id.job); }
  struct News {
    std::set<JobId> changed = {};
    std::set<JobId> unexplained = {};
  };
  // The changes since the publisher last took them out.
  [[nodiscard]] News& news() { return news_; }

 private:
  void explain_with_next(const Step& step);

  Version changes_ = 0;
  std::unordered_map<StepId, Step> steps_;
  JobIds ids_;
  std::set<JobId> active_;
  std::vector<JobId> past_queue_;  // few, ascending
  std::set<JobId> undecided_;
  std::set<JobId> being_replanned_;
  std::size_t goals_ = 0;
  std::map<JobId, std::vector<JobId>> followers_;  // jobs that name the key in Submit::after
  std::map<int, std::size_t> priorities_;          // number of active jobs per priority
  ArmQueues queues_;
  News news_;
};

// Returns the jobs that are admitted, braking or held.
[[nodiscard]] std::vector<const Step*> occupying(const JobBook& book);
// Returns true if the job first lets another job pass that waits.
[[nodiscard]] bool lets_another_pass(const JobBook& book, const Step& step);
// Returns these jobs sorted by Job::turn, except that jobs of the same arm keep the order of its
// queue.
[[nodiscard]] std::vector<JobId> in_turn(const JobBook& book, const std::set<JobId>& jobs);

}  // namespace armloom
