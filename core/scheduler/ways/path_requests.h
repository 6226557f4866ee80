#pragma once

#include "core/jobs/transitions.h"
#include "core/scheduler/waiting/wait_cycles.h"

namespace armloom {

// Sends the question (PlanMotion). Returns the request with what the question is about, to be
// stored by its owner. Precondition: none for this purpose is open.
PathRequest send(Transitions& state, const Step& step, PlanPurpose purpose, PathRequest request,
                 PlanQuestion question);
// Passes the answer on to the purpose that it was asked for: a goal (goals.h), a detour, a replan
// (replanning.h) or a retreat (yielding/yield_moves.h).
void take_plan(Transitions& state, const PlanMade& answer, WaitCycles& cycles);

}  // namespace armloom
