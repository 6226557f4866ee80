#pragma once

#include "core/scheduler/yielding/yield_moves.h"

namespace armloom {

// Adds the retreat as a job of the scheduler. If the arm has a job that begins at its present rest,
// a return before that job is added too. A job with a goal needs no return, but lets the blocked
// job pass first.
void send_aside(State& state, const YieldTrial& move);

}  // namespace armloom
