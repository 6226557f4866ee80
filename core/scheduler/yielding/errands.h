#pragma once

#include "core/jobs/state.h"

namespace armloom {

// Moves of the scheduler's own that still wait when the client's job that they were to help has
// ended: they help the next one of their arm that counts on them, so that others make way for them
// on its behalf; where that one does not, they end, so that nobody waits for them.
void pass_errands_on(State& state);

}  // namespace armloom
