#pragma once

#include "core/jobs/transitions.h"
#include "core/scheduler/waiting/wait_cycles.h"

namespace armloom {

// Sends the question (PlanMotion). Returns the request with what the question is about, to be
// stored by its owner. Precondition: none of the request is open.
[[nodiscard]] PathRequest send(Transitions& state, const Step& step, PathRequest request,
                               PlanQuestion question);
// Passes the answer on to the purpose whose question is open: a goal (goals.h), a detour, a replan
// (replanning.h) or a retreat (yielding/yield_moves.h).
void take_plan(Transitions& state, const PlanMade& answer, WaitCycles& cycles);

}  // namespace armloom
