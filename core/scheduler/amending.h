#pragma once

#include "core/jobs/inputs.h"
#include "core/jobs/transitions.h"

namespace armloom {

// Changes the terms of a job that has not ended. After a change of the priority, all waiting jobs
// are checked again, the answer to an open question is void, and the policy may choose passing
// orders again. Jobs that the server has added for this job get the same priority.
void amend(Transitions& state, const Amend& input);

}  // namespace armloom
