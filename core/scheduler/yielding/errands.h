#pragma once

#include "core/jobs/transitions.h"

namespace armloom {

// Handles the server's own waiting jobs (retreats, returns, moves-to-start) whose client job has
// ended. If the next client job of the arm relies on such a job, it now helps that job. Otherwise
// it is canceled, so that no job waits for it.
void pass_errands_on(Transitions& state);

}  // namespace armloom
