#pragma once

#include "core/jobs/inputs.h"
#include "core/jobs/state.h"

namespace armloom {

// What of a job is changed while it has not ended. With another priority everything that waits is
// judged again, and an answer that is still to come is void: from now on who goes first is decided
// by it, and by which order admitted motions pass, where the policy weighs that again. What the
// server does on the job's behalf is as urgent as the job.
void amend(State& state, const Amend& input);

}  // namespace armloom
