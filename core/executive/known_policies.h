#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/problem.h"

namespace armloom {

// The names that ExecutiveOptions::policy may have, in order of ambition.
[[nodiscard]] std::vector<std::string> known_policies();
// What is wrong with a name; nothing: it is known.
[[nodiscard]] std::optional<Problems> policy_problems(const std::string& name);

}  // namespace armloom
