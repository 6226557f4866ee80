#pragma once

#include <cstddef>
#include <optional>

#include "core/deadlock/waits_for.h"
#include "core/jobs/state.h"

namespace armloom {

// Retreats of arms that rest in a job's path (scheduling.on_idle_blocker), without a job of their
// own or in a deadlock cycle. Each candidate is first checked: is its path free, and would the job
// then pass?
struct YieldTrial {
  JobId blocked_job;
  ArmId arm;
  TrajectoryPtr way;                 // null: to be planned first (ways/planned_aside.h)
  std::optional<JobId> before = {};  // the arm's own job that the retreat precedes
  bool is_free = false;              // `way` is known to be free
  std::size_t index = 0;             // into the candidates from the arm's present rest
};

// Returns the first untried retreat for a job that waits for an arm that no job will move. Marks
// the waits of jobs for which no candidate is left.
[[nodiscard]] std::optional<YieldTrial> next_yield(State& state);
// Returns a retreat of an arm in the cycle, or nullopt. Each job of a cycle waits for the next one,
// mostly for an arm that only the next one will move: could that arm move before its job? The arm
// whose job would otherwise fail is tried first. No retreat if the cycle contains a dispensable
// retreat.
[[nodiscard]] std::optional<YieldTrial> yield_in(const State& state, const WaitCycle& ring);

// Returns the question whether the path is free or, if that is known, whether the job would pass.
[[nodiscard]] Question question_about(const State& state, const YieldTrial& move);
// Returns true if the trial still applies: the job is active, and the arm still has no job, or the
// same first job.
[[nodiscard]] bool is_as_asked(const State& state, const YieldTrial& move);
// Returns true if nothing that stays blocks the retreat (an object, the arm itself, an arm of the
// cycle) or, once that is known to be free, the job (the retreated arm).
[[nodiscard]] bool lets_through(const State& state, const Verdict& verdict, const YieldTrial& move);
// Records the result of a trial.
void note_tried(State& state, const YieldTrial& move, bool goes);

// Returns true if the client's next job on this arm begins where the scheduler's own job leaves the
// arm, and not where the arm rests without it.
[[nodiscard]] bool is_counted_on(const State& state, const Record& own);

}  // namespace armloom
