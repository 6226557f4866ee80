#pragma once

#include "core/executive/events.h"
#include "server/store/job_history.h"

namespace armloom {

// What people are told of what the data folder holds and cannot be read, or is not as it was
// written. Precondition: there is some.
[[nodiscard]] Alert alert_of(const Damage& damage);

}  // namespace armloom
