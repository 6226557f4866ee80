#pragma once

#include <cstddef>
#include <optional>

#include "core/deadlock/waits_for.h"
#include "core/jobs/state.h"

namespace armloom {

// Retreats of arms without a job, or in a deadlock cycle (scheduling.on_idle_blocker). Each
// candidate is checked first: is its path free, and would the blocked job then pass?
struct YieldTrial {
  JobId blocked_job;
  ArmId arm;
  TrajectoryPtr way;                 // null if to be planned (planned_aside.h)
  std::optional<JobId> before = {};  // the arm's job that it precedes
  bool is_free = false;              // `way` is known to be free
  std::size_t index = 0;             // into the candidates from the arm's present rest
};

// Returns the first untried retreat for a job that waits for an idle arm. Marks waits without
// candidates.
[[nodiscard]] std::optional<YieldTrial> next_yield(State& state);
// Returns a retreat of an arm in the cycle that could move before its job, or nullopt. Tries the
// arm first whose job would otherwise fail. None if the cycle contains a dispensable retreat.
[[nodiscard]] std::optional<YieldTrial> yield_in(const State& state, const WaitCycle& ring);

// Asks whether the path is free or, if known, whether the job would pass.
[[nodiscard]] Question question_about(const State& state, const YieldTrial& move);
// Returns true if the job is active and the arm still has no job, or the same first job.
[[nodiscard]] bool is_as_asked(const State& state, const YieldTrial& move);
// Returns true if nothing that stays blocks the retreat (an object, the arm itself, an arm of the
// cycle) or, if `is_free`, the job.
[[nodiscard]] bool lets_through(const State& state, const Verdict& verdict, const YieldTrial& move);
void note_tried(State& state, const YieldTrial& move, bool goes);

// Returns true if the arm's next client job begins where the own job leaves the arm.
[[nodiscard]] bool is_counted_on(const State& state, const Record& own);

}  // namespace armloom
