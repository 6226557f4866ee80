#pragma once

#include "core/jobs/transitions.h"

namespace armloom {

// Measures the pace of a job in motion, and its time until an overrun, from now on. `rested`: the
// time until now is no standstill.
void renew_clocks(Transitions& state, const Step& step, bool rested);

// Sets the speed override. Passing orders stay, because they are about progress. What depends on
// time is renewed: times of overrun, paces, predictions and scheduled starts. Under policies
// without passing orders, all motions under way are checked again.
void set_speed(Transitions& state, const SetSpeed& input);
void set_brake(Transitions& state, const SetBrake& input);

// Call when jobs of the arms may have a new answer to operator_wait().
void explain_again(Transitions& state, const std::vector<ArmId>& arms);

}  // namespace armloom
