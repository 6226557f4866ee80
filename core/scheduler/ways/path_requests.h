#pragma once

#include "core/jobs/state.h"
#include "core/scheduler/waiting/wait_cycles.h"

namespace armloom {

// Sends the question (PlanMotion) and records what it is about. Precondition: none of the request
// is open.
void send(State& state, Step& step, PathRequest& request, PlanQuestion question);
// Passes the answer on to the purpose whose question is open: a goal (goals.h), a detour, a replan
// (replanning.h) or a retreat (planned_aside.h).
void take_plan(State& state, const PlanMade& answer, WaitCycles& cycles);

}  // namespace armloom
