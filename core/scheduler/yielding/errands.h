#pragma once

#include "core/jobs/state.h"

namespace armloom {

// Handles waiting retreats, returns and moves-to-start whose client job has ended: each is passed
// on to the next client job of its arm that relies on it, so that it keeps priority and retreats of
// others; otherwise it ends, so that no job waits for it.
void pass_errands_on(State& state);

}  // namespace armloom
