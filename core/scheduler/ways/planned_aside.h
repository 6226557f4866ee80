#pragma once

#include "core/jobs/state.h"
#include "core/scheduler/yielding/yield_moves.h"

namespace armloom {

// Planned retreats, if none of the straight ones is free (yield_moves.cc) and the cell wants
// planned paths (on_idle_blocker "replan"): to any position that clears the blocked job's path.
// Planned once from where the arm came to rest; then tried like any other retreat.

// Requests the plan (PlanMotion) unless it is open. Precondition: the trial has no path.
void ask_for_way_aside(State& state, const YieldTrial& move);
// Takes the answer to a PlanMotion if it is for a retreat.
void take_way_aside(State& state, const PlanMade& answer);

}  // namespace armloom
