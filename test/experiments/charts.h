#pragma once

#include <string>

#include "test/experiments/run_all.h"

namespace armloom::experiments {

// Self-contained SVG 1.1.

// A bar for each policy's mean makespan, a dot for each seed, the lower bound dashed.
[[nodiscard]] std::string makespan_svg(const WorkloadKind& kind, const std::vector<RunRow>& rows);

}  // namespace armloom::experiments
