#pragma once

#include <vector>

#include "core/jobs/transitions.h"

namespace armloom {

// Admits the steps with these orders, in one step of the scheduler: their motions enter the
// precedence graph. `candidates`: the motion of each step, in the same order.
void admit(Transitions& state, const std::vector<StepId>& steps,
           std::vector<CoordinatedMotion> candidates, const PassingOrders& orders);

// Records that a check found the admitted motion free in the present version.
void note_free(Transitions& state, const Step& step);

}  // namespace armloom
