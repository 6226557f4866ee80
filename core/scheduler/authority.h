#pragma once

#include "core/jobs/state.h"

namespace armloom {

// Movement authority of admitted motions, as far as passing orders allow.

// Dispatches admitted motions that precedence lets leave, and extends the authority of motions
// under way.
void dispatch_ready(State& state);
// Does the same for the motion that moved and for motions that wait for it.
void extend_authority(State& state, JobId moved);
// Notes when a motion pauses at its limit; time lost there is no overrun.
void see_pauses(State& state, Record& record, Duration progress_before);

}  // namespace armloom
