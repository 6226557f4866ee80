#pragma once

#include "core/jobs/transitions.h"
#include "core/scheduler/yielding/yield_moves.h"

namespace armloom {

// Planned retreats, to any position that clears the blocked job's path. One is planned if no
// retreat along a known path is possible (yield_moves.cc) and the cell's on_idle_blocker is
// "replan". It is planned once for each place where the arm comes to rest, and then tried like any
// other retreat.

// Requests the plan (PlanMotion), unless a request is open. Precondition: the trial has no path.
void ask_for_way_aside(Transitions& state, const YieldTrial& move);
// Handles the planner's answer for a retreat of the arm.
void take_way_aside(Transitions& state, const Step& step, ArmId arm, const PlanMade& answer);

}  // namespace armloom
