#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/jobs/inputs.h"
#include "core/jobs/queue_ends.h"
#include "core/jobs/timeline.h"
#include "core/jobs/transitions.h"
#include "core/policies/policy.h"
#include "core/scheduler/admission.h"
#include "core/scheduler/waiting/wait_cycles.h"
#include "core/scheduler/ways/goals.h"
#include "core/scheduler/ways/path_requests.h"

namespace armloom {

// The core of Armloom: queue, backlog, arm queues, passing orders, stops. It is a deterministic
// state machine without threads, clock, sockets or geometry. README.md lists its modules.
//
// Under every policy an admitted job is a motion in the precedence graph (precedence_graph.h). It
// gets authority as far as the passing orders allow, and otherwise waits at its start or pauses on
// its path. The policy chooses the orders (none under timed_discrete). Orders do not depend on
// times, so they also hold if an arm is late.
//
// Every change of the admitted motions, of an arm's rest or of the scene makes a new version. A
// verdict for an older version is void, and every waiting job is checked again.
//
// An arm that comes to rest elsewhere than planned (canceled, faulted) blocks the motions that
// would pass there. After a change of the scene, admitted motions are checked again and braked if
// they are in conflict.
class Scheduler {
 public:
  // `rest`: the initial position of every joint. The policy is not null. Jobs of earlier sessions
  // have ids below `first`.
  Scheduler(CellPtr cell, std::shared_ptr<const Policy> policy, Configuration rest,
            JobId first = JobId{1});
  // Creates a scheduler for questions about further jobs (Trial): at `now`, the motions `under_way`
  // are at their progress, without orders between them. Under policies with rounds they form one
  // round. Preconditions: at most one motion per arm;
  // their ids grow. `rest`: where these motions started.
  Scheduler(CellPtr cell, std::shared_ptr<const Policy> policy, Configuration rest,
            const std::vector<Motion>& under_way, TimePoint now);

  // Handles one input and returns the effects, which must be carried out in order. Ignores inputs
  // for unknown or ended jobs. Throws std::invalid_argument if `now` decreases. Throws
  // std::logic_error if an invariant (invariants.h) is broken: then earlier effects are not
  // reliable either.
  [[nodiscard]] std::vector<Effect> step(const Input& input, TimePoint now);

  // Everything that the rules decide by. Valid until the next step().
  [[nodiscard]] const State& state() const { return state_; }

  // Returns the id for the next job to be submitted. Call again after each step(): the scheduler
  // may have used the id for a job of its own.
  [[nodiscard]] JobId next_job() const { return state_->jobs.next_id(); }
  // Returns the time of the last WakeAt.
  [[nodiscard]] std::optional<TimePoint> wakes_at() const { return wake_at_; }
  [[nodiscard]] const Policy& policy() const { return *state_->policy; }
  // `question` has a single candidate, and `verdict` is its answer. Returns the candidate's
  // earliest start by the clock, from now; nullopt if none is found.
  [[nodiscard]] std::optional<Duration> earliest_start(const Question& question,
                                                       const Verdict& verdict) const;

  [[nodiscard]] PredictedTimeline timeline(TimePoint now) const {
    return predicted_timeline(state_, now);
  }

  // Returns when the active job expires (deadlines.h).
  [[nodiscard]] std::optional<TimePoint> expiry(JobId job) const;

  [[nodiscard]] const Step* find(JobId job) const;  // null if unknown or forgotten
  [[nodiscard]] std::vector<JobId> active() const;  // all not ended, in order of submission
  // Returns true if the job could start but for the actions of its task before it.
  [[nodiscard]] bool has_turn_for_actions(JobId job) const;
  // Returns the first job of the arm's queue.
  [[nodiscard]] std::optional<JobId> head(ArmId arm) const;
  [[nodiscard]] bool stopped(ArmId arm) const { return state_->arms.is_stopped(arm); }
  [[nodiscard]] std::optional<JobId> occupant(ArmId arm) const;  // in motion, braking or held
  // Forgets an ended job. Until then the caller can read its result.
  void forget(JobId ended);

 private:
  void on(const Submit& input);
  void on(const Cancel& input);
  void on(const Judged& input) { admission_.on(input, state_, cycles_); }
  void on(const PlanMade& input) { take_plan(state_, input, cycles_); }
  void on(const Replan& input);
  void on(const MotionReport& input);
  void settle();
  [[nodiscard]] bool is_due();
  void look_ahead();
  void ask_for_wake();

  Transitions state_;
  WaitCycles cycles_;
  Admission admission_;
  std::optional<TimePoint> deadline_;   // of jobs and deadlock cycles
  std::optional<TimePoint> weighs_at_;  // when to compare motions with their prediction
  std::optional<TimePoint> wake_at_;    // the earlier of both
};

}  // namespace armloom
