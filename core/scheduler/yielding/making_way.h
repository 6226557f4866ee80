#pragma once

#include "core/scheduler/yielding/yield_moves.h"

namespace armloom {

// Adds the retreat as a job, and a return if the arm has a job that begins at its present rest. A
// job with a goal instead lets the blocked job pass first.
void send_aside(State& state, const YieldTrial& move);

}  // namespace armloom
