#pragma once

#include <string>

#include "core/coordination/verdict.h"
#include "core/jobs/job.h"
#include "core/precedence/passing_orders.h"

namespace armloom {

// What a job waits for because of a conflict, or of what blocks it.
[[nodiscard]] Wait wait_for(const Conflict& conflict);
[[nodiscard]] Wait wait_for(const Blocker& blocker);
// Of a job whose arms would hit themselves or each other: what, how and when.
[[nodiscard]] std::string self_collision_text(const Conflict& conflict);
// "12.5 s"
[[nodiscard]] std::string seconds_text(Duration duration);

}  // namespace armloom
