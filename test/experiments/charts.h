#pragma once

#include <string>

#include "test/experiments/run_all.h"

namespace armloom::experiments {

// Self-contained SVG 1.1.

// Draws a bar for each policy's mean makespan, a dot for each seed, and a dashed line for the lower
// bound.
[[nodiscard]] std::string makespan_svg(const WorkloadKind& kind, const std::vector<RunRow>& rows);

}  // namespace armloom::experiments
