#pragma once

#include <vector>

#include "core/jobs/state.h"

namespace armloom {

// Admits the steps with these orders, in one step of the scheduler: their motions enter the
// precedence graph. `candidates`: the motion of each step, in the same order.
void admit(State& state, const std::vector<StepId>& steps,
           std::vector<CoordinatedMotion> candidates, const PassingOrders& orders);

// Records that a check found the admitted motion free in the present version.
void note_free(State& state, Step& step);

}  // namespace armloom
