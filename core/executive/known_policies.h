#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/problem.h"

namespace armloom {

// Returns the valid values of ExecutiveOptions::policy, the simplest policy first.
[[nodiscard]] std::vector<std::string> known_policies();
// Returns the problems of a policy name; nullopt if it is known.
[[nodiscard]] std::optional<Problems> policy_problems(const std::string& name);

}  // namespace armloom
