#pragma once

#include "core/scheduler/yielding/yield_moves.h"

namespace armloom {

// Adds the retreat as a job. If the arm's next job is in the deadlock cycle and begins where the
// arm is now, also adds a job that brings the arm back. A next job with a goal begins where the
// retreat ends, and lets the blocked job pass first.
void send_aside(State& state, const YieldTrial& move);

}  // namespace armloom
