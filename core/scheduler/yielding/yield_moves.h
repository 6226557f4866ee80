#pragma once

#include <cstddef>
#include <optional>

#include "core/deadlock/waits_for.h"
#include "core/jobs/state.h"

namespace armloom {

// Arms that rest in the way go aside (scheduling.on_idle_blocker "park"): without a job, or in a
// ring. Each way is asked about first: whether it is free, and whether the job would then pass.
struct YieldTrial {
  JobId blocked_job;
  ArmId arm;
  TrajectoryPtr way;                 // null: it has to be planned first (ways/planned_aside.h)
  std::optional<JobId> before = {};  // YieldMove::before
  bool is_free = false;              // the way; else that is the question
  std::size_t index = 0;             // of the ways from where the arm rests
};

// For the first job that waits for an arm which no job will move. Those before it for which nothing
// is left to be tried are told so.
[[nodiscard]] std::optional<YieldTrial> next_yield(State& state);
// Of an arm of the ring. Each job of a ring waits for the next one, mostly for the arm that only
// that will move: could it move before its job? The one whose job would have to give way otherwise
// is tried first. Not where a move aside is in the ring that can give way itself.
[[nodiscard]] std::optional<YieldTrial> yield_in(const State& state, const WaitCycle& ring);

// First whether the way itself will be free, then whether the job would find the arm gone.
[[nodiscard]] Question question_about(const State& state, const YieldTrial& move);
// The job still waits; the arm has got none meanwhile, nor lost the one that it is to go before.
[[nodiscard]] bool is_as_asked(const State& state, const YieldTrial& move);
// Whether nothing that stays keeps the arm from its way, or, where that is free, the job from its
// own: an object, the moving arm itself, an arm of the ring; or the arm that has gone aside.
[[nodiscard]] bool lets_through(const State& state, const Verdict& verdict, const YieldTrial& move);
// It has been asked about to the end; it goes, or not.
void note_tried(State& state, const YieldTrial& move, bool goes);

// A client's job behind this one of one's own does not begin where their arm stands without it.
[[nodiscard]] bool is_counted_on(const State& state, const Record& own);

}  // namespace armloom
