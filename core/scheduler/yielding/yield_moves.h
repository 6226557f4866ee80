#pragma once

#include <cstddef>
#include <optional>

#include "core/deadlock/waits_for.h"
#include "core/jobs/transitions.h"

namespace armloom {

// Retreats of arms that have no job or are in a deadlock cycle (scheduling.on_idle_blocker). Each
// candidate is checked first: is its path free, and could the blocked job then pass?
struct YieldTrial {
  JobId blocked_job;
  ArmId arm;
  TrajectoryPtr way;                 // null if it must be planned first (ask_for_way_aside)
  std::optional<JobId> before = {};  // in a deadlock cycle: the arm's job that it precedes
  bool is_free = false;              // `way` is known to be free
  std::size_t index = 0;             // into the candidates from the arm's present rest
};

// Returns what was tried with retreats of this arm for the job.
[[nodiscard]] const YieldsTried& tried_for(const Step& step, ArmId arm);

// Returns the first untried retreat of an idle arm for which a job waits. If none is left, marks
// the wait (Wait::has_no_way_aside).
[[nodiscard]] std::optional<YieldTrial> next_yield(Transitions& state);
// Returns an untried retreat of an arm in the cycle, before that arm's job; nullopt if there is
// none. Tries the arm first whose job was submitted last and would fail otherwise. Returns nullopt
// if the cycle contains a retreat that no client job needs, because that retreat fails instead.
[[nodiscard]] std::optional<YieldTrial> yield_in(const State& state, const WaitCycle& ring);

// Returns the question whether the retreat's path is free. If that is known already, returns the
// question whether the blocked job could then pass.
[[nodiscard]] Question question_about(const State& state, const YieldTrial& move);
// Returns true if the trial still applies: the blocked job has not ended, and the arm still has no
// job, or still the same first job.
[[nodiscard]] bool is_as_asked(const State& state, const YieldTrial& move);
// Returns true if the verdict lets the retreat pass; with `is_free`, the blocked job. Conflicts
// with arms that may still move away do not matter.
[[nodiscard]] bool lets_through(const State& state, const Verdict& verdict, const YieldTrial& move);
// Records that the retreat was tried, and if `goes` that it is made.
void note_tried(Transitions& state, const YieldTrial& move, bool goes);

// Planned retreats, to any position that clears the blocked job's path. One is planned if no
// retreat along a known path is possible and the cell's on_idle_blocker is
// "replan". It is planned once for each place where the arm comes to rest, and then tried like any
// other retreat.

// Requests the plan (PlanMotion), unless a request is open. Precondition: the trial has no path.
void ask_for_way_aside(Transitions& state, const YieldTrial& move);
// Handles the planner's answer for a retreat of the arm.
void take_way_aside(Transitions& state, const Step& step, ArmId arm, const PlanMade& answer);

// Returns true if the arm's next client job relies on `own`, a job of the server: the job begins
// where `own` brings the arm. False for a job with a goal, which begins anywhere.
[[nodiscard]] bool is_counted_on(const State& state, const Step& own);

}  // namespace armloom
