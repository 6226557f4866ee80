#pragma once

#include "core/jobs/inputs.h"
#include "core/jobs/state.h"

namespace armloom {

// Changes the terms of a job that has not ended. A new priority makes open answers void; all
// waiting jobs are checked again, and the policy may re-optimize passing orders. Jobs that the
// server has added for this job get the same priority.
void amend(State& state, const Amend& input);

}  // namespace armloom
