#pragma once

#include "core/jobs/state.h"

namespace armloom {

// How far each motion that is admitted may go: orders, held by authority over progress.

// Tells what is admitted to its arms when precedence lets it leave its place, and how much farther
// what is under way may go.
void dispatch_ready(State& state);
// The same of what waits for this motion, and of itself: it has moved.
void extend_authority(State& state, JobId moved);
// At rest at its limit a running motion pauses; what it loses there is no overrun.
void see_pauses(State& state, Record& record, Duration progress_before);

}  // namespace armloom
