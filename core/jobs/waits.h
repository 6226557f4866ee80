#pragma once

#include <string>

#include "core/coordination/verdict.h"
#include "core/jobs/step.h"
#include "core/precedence/passing_orders.h"

namespace armloom {

// Return the wait caused by a conflict or a blocker.
[[nodiscard]] Wait wait_for(const Conflict& conflict);
[[nodiscard]] Wait wait_for(const Blocker& blocker);
// Returns the detail of Reason::self_collision: links, distance and time.
[[nodiscard]] std::string self_collision_text(const Conflict& conflict);
// "12.5 s"
[[nodiscard]] std::string seconds_text(Duration duration);

}  // namespace armloom
