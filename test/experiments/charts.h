#pragma once

#include <string>

#include "test/experiments/run_all.h"

namespace armloom::experiments {

// Self-contained SVG 1.1.

// Returns a bar for each policy's mean makespan, a dot for each seed, and the lower bound as a
// dashed line.
[[nodiscard]] std::string makespan_svg(const WorkloadKind& kind, const std::vector<RunRow>& rows);

}  // namespace armloom::experiments
