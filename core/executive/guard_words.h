#pragma once

#include <string>

#include "core/coordination/guard_refusal.h"
#include "core/model/cell.h"

namespace armloom {

// "authority guard: left may not go from 0.30 s to 0.85 s: right is at 0.82 s, and these positions
// are in a conflict region"
[[nodiscard]] std::string sentence(const GuardRefusal& refusal, const Cell& cell);

}  // namespace armloom
