#pragma once

#include "core/jobs/transitions.h"

namespace armloom {

// Gives admitted motions authority to move, as far as their passing orders allow.

// Returns when the motion may have overrun if it continues from now at its speed override.
[[nodiscard]] TimePoint overrun_after(const State& state, const Step& step);
// Dispatches admitted motions whose orders let them leave their start, and extends the authority of
// motions under way.
void dispatch_ready(Transitions& state);
// Does the same, but only for the motion that moved and for the motions that pass after it.
void extend_authority(Transitions& state, StepId moved);
// Records that a motion pauses at its limit or continues. Time that it loses there does not count
// as overrun.
void see_pauses(Transitions& state, const Step& step, Duration progress_before);

}  // namespace armloom
