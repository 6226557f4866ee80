#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "core/model/cell.h"

namespace armloom {

// The names that ExecutiveOptions::policy may have, in order of ambition.
[[nodiscard]] std::vector<std::string> known_policies();
// What is wrong with a name, for this cell; nothing: it is known.
[[nodiscard]] std::optional<Problems> policy_problems(const std::string& name, const Cell& cell);

}  // namespace armloom
