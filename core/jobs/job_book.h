#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <ranges>
#include <set>
#include <vector>

#include "core/jobs/active_jobs.h"
#include "core/jobs/arm_queues.h"
#include "core/jobs/inputs.h"
#include "core/jobs/step_facts.h"

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

using Steps = std::vector<std::reference_wrapper<const Step>>;

// All jobs and their places in the arm queues. Others read; the public transitions concern a job
// alone. Those with consequences for orders, rests or the safe sequence belong to Transitions.
class JobBook : public StepFacts {
 public:
  JobBook(std::size_t arms, JobId first) : ids_(first), queues_(arms) {}
  // A copy is independent. Not assignable: only the transitions change a book.
  JobBook(const JobBook&) = default;
  JobBook(JobBook&&) = default;

  [[nodiscard]] JobId next_id() const { return ids_.next(); }
  [[nodiscard]] const ActiveJobs& active() const { return active_; }
  // Return ActiveJobs::past_queue(). Do not change states while you use past_queue();
  // past_queue_now() is a copy.
  [[nodiscard]] auto past_queue() const { return of(active_.past_queue()); }
  [[nodiscard]] Steps past_queue_now() const { return {past_queue().begin(), past_queue().end()}; }
  // Returns the first step of each queue that is not empty.
  [[nodiscard]] auto heads() const {
    return std::views::transform(
        std::views::filter(queues_, [](const ArmQueues::Queue& queue) { return !queue.empty(); }),
        [this](const ArmQueues::Queue& queue) -> const Step& { return at(queue.front()); });
  }
  [[nodiscard]] const ArmQueues& queues() const { return queues_; }

  // Forgets a job that has ended.
  void forget(JobId job) { steps_.erase(only_step(job)); }
  // Moves a queued job to the backlog, or back to the queue. `clock`: the motion clock.
  void put_in_backlog(const Step& step, TimePoint now, TimePoint clock);
  void leave_backlog(const Step& step);
  // Assigns the job to its present arm for good. Precondition: the job is waiting.
  void decide_arm(const Step& step);
  // The arms have moved.
  void start(const Step& step, TimePoint now);
  // Sets when the motion starts. Once it is dispatched, its measured start is published instead.
  void schedule(const Step& step, std::optional<TimePoint> at);
  void set_off_path(const Step& step, double distance) { edit(step).off_path = distance; }

 private:
  friend class Transitions;

  // Adds a job at the end of its arms' queues, or before Errand::before in the queues that contain
  // it. Throws like JobIds::take().
  const Step& add(Step step);
  // Throws std::logic_error for transitions that are not in the table of step.h.
  void enter(const Step& step, StepPhase phase);
  // Moves the job to Ended and out of the queues. Returns the active jobs that named it in `after`,
  // and removes it there.
  [[nodiscard]] std::vector<JobId> end(const Step& step, Ended how);
  // Reorders waiting jobs that occupy consecutive places on the same arms.
  void put_in_order(const std::vector<JobId>& jobs);
  // Gives a waiting job one of its alternatives, at position `place` of that arm's queue.
  void take(const Step& step, std::size_t which, WaitingLeg leg, std::size_t place);
  // Gives the path the number that it had before.
  void restore(const Step& step, std::uint64_t motion) { edit(step).leg.motion = motion; }
  // Sets the planned or a new path. Precondition: the job waits in the queue.
  void set_motion(const Step& step, TrajectoryPtr trajectory, WaitingLeg leg);
  // Replaces one of the job's alternatives. If the job has this one now, its motion changes too.
  void set_alternative(const Step& step, std::size_t which, TrajectoryPtr trajectory,
                       WaitingLeg leg);
  // Sets JobGoal::is_planned. Returns true if it was different.
  bool set_planned(const Step& step, bool is_planned);
  // Precondition: the job has not ended.
  void amend(const Step& step, AmendedTerms terms);
  void measure(const Step& step, const MotionReport& report, TimePoint now);
  // The job begins again, on a new path.
  void start_over(const Step& step);

  // Returns the job, to be changed. Copies of this book keep the job as it was.
  [[nodiscard]] static Job& change(Step& step);
  void explain_with_next(const Step& step);

  JobIds ids_;
  ActiveJobs active_;
  ArmQueues queues_;
};

// Returns the jobs that are admitted, braking or held.
[[nodiscard]] std::vector<const Step*> occupying(const JobBook& book);
// Returns true if the job first lets another job pass that waits.
[[nodiscard]] bool lets_another_pass(const JobBook& book, const Step& step);
// Returns these jobs sorted by Job::turn, except that jobs of the same arm keep the order of its
// queue.
[[nodiscard]] std::vector<JobId> in_turn(const JobBook& book, const std::set<JobId>& jobs);

}  // namespace armloom
