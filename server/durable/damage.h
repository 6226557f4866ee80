#pragma once

#include "core/executive/events.h"
#include "server/store/job_history.h"

namespace armloom {

// Returns the alert on damaged contents of the data folder. Precondition: there is damage.
[[nodiscard]] Alert alert_of(const Damage& damage);

}  // namespace armloom
