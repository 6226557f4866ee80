#pragma once

#include "core/jobs/state.h"

namespace armloom {

// Sets the speed override. Passing orders stay, because they are about progress. What depends on
// time is renewed: times of overrun, paces, predictions and scheduled starts. Under policies
// without passing orders, all motions under way are checked again.
void set_speed(State& state, const SetSpeed& input);

// Call when jobs of the arm may have a new answer to operator_wait().
void explain_again(State& state, ArmId arm);

}  // namespace armloom
