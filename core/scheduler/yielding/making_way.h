#pragma once

#include "core/scheduler/yielding/yield_moves.h"

namespace armloom {

// Jobs of the scheduler's own take the arm out of the way, and, where it has a job that begins
// where it stands, back before that; one that is a goal lets the other pass first.
void send_aside(State& state, const YieldTrial& move);

}  // namespace armloom
