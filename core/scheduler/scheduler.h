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

// The pure heart: queue, backlog, lanes and orders, stops. A deterministic state machine without
// threads, clock, sockets or geometry. The way of a job through its rooms: README.md.
//
// What is admitted, under every policy, is a motion in the precedence graph (precedence_graph.h):
// it is granted authority as far as the orders let it, and waits at its start or pauses on its way
// where they do not. The policy chooses the orders; nothing that moves counts on times, so that
// late arms disturb nobody, and braking ones need not be waited for. Under timed_discrete there are
// none.
//
// Whatever changes what is admitted, or where arms rest, makes a new version: a verdict on an older
// one is void and asked again, and every waiting job is tried again on the new one.
//
// An arm that comes to rest off its plan (canceled, faulted) holds those that would pass there
// where they may be. A scene that changes may endanger motions that were admitted before: these are
// judged again, and those in conflict are held until the way is free.
class Scheduler {
 public:
  // `rest` is where every joint stands at the beginning. The policy is not null. Jobs of former
  // runs have the ids below `first`, and may come with them.
  Scheduler(CellPtr cell, std::shared_ptr<const Policy> policy, Configuration rest,
            JobId first = JobId{1});
  // As it would be at `now` amid motions that are under way, each at its progress, nothing having
  // been decided between them: for questions about what else could go (Trial). At most one of an
  // arm; their ids grow. `rest` is where these set out.
  Scheduler(CellPtr cell, std::shared_ptr<const Policy> policy, Configuration rest,
            const std::vector<Motion>& under_way, TimePoint now);

  // Time never goes backwards (throws std::invalid_argument). An input that names an unknown or
  // ended job is ignored. Effects are to be carried out in order. Throws std::logic_error where an
  // invariant (invariants.h) is broken: then nothing that it says is to be relied on.
  [[nodiscard]] std::vector<Effect> step(const Input& input, TimePoint now);

  // Where every joint stands, as far as it is not in motion; there where it set out.
  [[nodiscard]] const Configuration& rest() const { return state_.arms.rest(); }
  // Where every joint will stand when all accepted jobs have succeeded: a new job has to begin
  // there.
  [[nodiscard]] Configuration predicted_rest() const;
  // Arms of which that is an estimate: the last goal is a pose, and not planned yet.
  [[nodiscard]] std::vector<ArmId> open_ends() const;

  // What the next job is to be called: not what an effect has called one of the scheduler's own.
  [[nodiscard]] JobId next_job() const { return state_.jobs.next_id(); }
  // The last WakeAt.
  [[nodiscard]] std::optional<TimePoint> wakes_at() const { return wake_at_; }
  [[nodiscard]] const Policy& policy() const { return *state_.policy; }
  // Nothing is admitted, so that it may be another one (ChangePolicy).
  [[nodiscard]] bool may_change_policy() const { return state_.graph.motions().empty(); }
  // By the clock, of the one candidate of a question that is open: when it could begin beside what
  // is admitted, from now. Nothing: not, as things stand.
  [[nodiscard]] std::optional<Duration> earliest_start(const Question& question,
                                                       const Verdict& verdict) const;

  // When what is admitted is expected to move.
  [[nodiscard]] PredictedTimeline timeline(TimePoint now) const {
    return predicted_timeline(state_, now);
  }

  [[nodiscard]] const Job* find(JobId job) const;   // null: unknown or forgotten
  [[nodiscard]] std::vector<JobId> active() const;  // all not ended, in order of submission
  // Returns true if a job that has not ended moves the arm, or will.
  [[nodiscard]] bool has_job(ArmId arm) const { return !state_.jobs.queues()[arm].empty(); }
  [[nodiscard]] bool stopped(ArmId arm) const { return state_.arms.is_stopped(arm); }
  // Nothing: it is not stopped.
  [[nodiscard]] const std::optional<std::string>& stop_cause(ArmId arm) const {
    return state_.arms.stop_cause(arm);
  }
  [[nodiscard]] std::optional<JobId> occupant(ArmId arm) const;  // in motion or held on this arm
  // All that is admitted comes to its end by its orders. For tests.
  [[nodiscard]] bool is_acyclic() const { return state_.graph.is_acyclic(); }
  // Ended jobs are kept until forgotten, so that the caller can read how they ended.
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
  std::optional<TimePoint> deadline_;   // of jobs and rings
  std::optional<TimePoint> weighs_at_;  // whether all goes as expected
  std::optional<TimePoint> wake_at_;    // the earlier one
};

}  // namespace armloom
