#pragma once

#include <string>
#include <vector>

#include "core/executive/events.h"

namespace armloom {

// What people are told of jobs of the data folder that cannot be read, or are not as they were
// written. Precondition: there are some.
[[nodiscard]] Alert alert_of_damaged(const std::vector<std::string>& ids);

}  // namespace armloom
