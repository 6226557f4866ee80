#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/jobs/inputs.h"
#include "core/jobs/phases.h"
#include "core/jobs/state.h"
#include "core/jobs/timeline.h"
#include "core/policies/policy.h"
#include "core/scheduler/admission.h"
#include "core/scheduler/amending.h"
#include "core/scheduler/waiting/wait_cycles.h"
#include "core/scheduler/ways/goals.h"

namespace armloom {

// The core of Armloom: queue, backlog, arm queues, passing orders, stops. A deterministic state
// machine without threads, clock, sockets or geometry. README.md lists its modules.
//
// Under every policy an admitted job is a motion in the precedence graph (precedence_graph.h): it
// gets authority as far as the orders allow, and otherwise waits at its start or pauses on its
// path. The policy chooses the orders (none under timed_discrete). Motions do not rely on times, so
// late arms disturb no other arm.
//
// Every change of the admitted motions, or of an arm's rest, makes a new version: a verdict for an
// older version is void, and every waiting job is checked again.
//
// An arm that rests elsewhere than planned (canceled, faulted) blocks the motions that would pass
// there. After a scene change, admitted motions are checked again and stopped if in conflict.
class Scheduler {
 public:
  // `rest`: the initial position of every joint. The policy is not null. Jobs of earlier sessions
  // have ids below `first`.
  Scheduler(CellPtr cell, std::shared_ptr<const Policy> policy, Configuration rest,
            JobId first = JobId{1});
  // The state at `now` with motions under way, each at its progress, without orders between them:
  // for questions about further jobs (Trial). At most one motion per arm; their ids grow. `rest`:
  // the positions where these motions started.
  Scheduler(CellPtr cell, std::shared_ptr<const Policy> policy, Configuration rest,
            const std::vector<Motion>& under_way, TimePoint now);

  // Handles one input and returns the effects, to be carried out in order. Throws
  // std::invalid_argument if `now` decreases, and std::logic_error if an invariant (invariants.h)
  // is broken: then nothing that it returned is reliable. Inputs for unknown or ended jobs are
  // ignored.
  [[nodiscard]] std::vector<Effect> step(const Input& input, TimePoint now);

  // Returns the rest position of every joint; for a moving joint the position where it started.
  [[nodiscard]] const Configuration& rest() const { return state_.arms.rest(); }
  // Returns where every joint will be when all accepted jobs have succeeded. A new job must begin
  // there.
  [[nodiscard]] Configuration predicted_rest() const;
  // Returns the arms for which predicted_rest() is an estimate: the last goal is an unplanned pose,
  // or a goal may still go to this or another arm.
  [[nodiscard]] std::vector<ArmId> open_ends() const;

  // Returns the id of the next job. Effects may use it up for the scheduler's own jobs.
  [[nodiscard]] JobId next_job() const { return state_.jobs.next_id(); }
  // Returns the time of the last WakeAt.
  [[nodiscard]] std::optional<TimePoint> wakes_at() const { return wake_at_; }
  [[nodiscard]] const Policy& policy() const { return *state_.policy; }
  // Returns true if no motion is admitted, so that ChangePolicy has an effect.
  [[nodiscard]] bool may_change_policy() const { return state_.graph.motions().empty(); }
  // Returns the earliest start by the clock, from now, of the single candidate of an open question;
  // nullopt if there is none.
  [[nodiscard]] std::optional<Duration> earliest_start(const Question& question,
                                                       const Verdict& verdict) const;

  [[nodiscard]] PredictedTimeline timeline(TimePoint now) const {
    return predicted_timeline(state_, now);
  }

  [[nodiscard]] const Job* find(JobId job) const;   // null if unknown or forgotten
  [[nodiscard]] std::vector<JobId> active() const;  // all not ended, in order of submission
  // Returns true if a job that has not ended moves the arm, or will.
  [[nodiscard]] bool has_job(ArmId arm) const { return !state_.jobs.queues()[arm].empty(); }
  [[nodiscard]] bool stopped(ArmId arm) const { return state_.arms.is_stopped(arm); }
  // Returns nullopt if the arm is not stopped.
  [[nodiscard]] const std::optional<std::string>& stop_cause(ArmId arm) const {
    return state_.arms.stop_cause(arm);
  }
  [[nodiscard]] std::optional<JobId> occupant(ArmId arm) const;  // in motion, braking or held
  // Returns true if all admitted motions can reach their ends by their orders. For tests.
  [[nodiscard]] bool is_acyclic() const { return state_.graph.is_acyclic(); }
  // Forgets an ended job. Until then the caller can read its result.
  void forget(JobId ended);

 private:
  void on(const Submit& input);
  void on(const Cancel& input);
  void on(const Judged& input) { admission_.on(input, state_, cycles_); }
  void on(const PlanMade& input);
  void on(const Replan& input);
  void on(const MotionReport& input);
  void settle();
  [[nodiscard]] bool is_due();
  void look_ahead();
  void ask_for_wake();

  State state_;
  WaitCycles cycles_;
  Admission admission_;
  std::optional<TimePoint> deadline_;   // of jobs and deadlock cycles
  std::optional<TimePoint> weighs_at_;  // when to compare with the prediction
  std::optional<TimePoint> wake_at_;    // the earlier of both
};

}  // namespace armloom
