#pragma once

#include "core/jobs/state.h"
#include "core/scheduler/yielding/yield_moves.h"

namespace armloom {

// Where none of the straight ways aside is free (yield_moves.cc) and the cell wants ways to be
// planned (on_idle_blocker "replan"): one to wherever the arm stands clear of the blocked job's
// motion. It is planned once from where the arm came to rest, and is then a trial like any other.

// Asks for it (PlanMotion), unless that is open. Precondition: the trial has no way.
void ask_for_way_aside(State& state, const YieldTrial& move);
// The answer to that, if it is one.
void take_way_aside(State& state, const PlanMade& answer);

}  // namespace armloom
