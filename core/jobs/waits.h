#pragma once

#include "core/coordination/verdict.h"
#include "core/jobs/job.h"
#include "core/precedence/passing_orders.h"

namespace armloom {

// What a job waits for because of a conflict, or of what blocks it.
[[nodiscard]] Wait wait_for(const Conflict& conflict);
[[nodiscard]] Wait wait_for(const Blocker& blocker);

}  // namespace armloom
