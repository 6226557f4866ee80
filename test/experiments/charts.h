#pragma once

#include <string>

#include "test/experiments/run_all.h"

namespace armloom::experiments {

// SVG 1.1, by themselves.

// A bar for each policy's mean makespan, a dot for each seed, the lower bound dashed.
[[nodiscard]] std::string makespan_svg(const WorkloadKind& kind, const std::vector<RunRow>& rows);
// Under each policy a lane for each arm: jobs pale, what moves full.
[[nodiscard]] std::string timeline_svg(const std::string& title, const Cell& cell,
                                       const std::vector<const Timeline*>& timelines);

}  // namespace armloom::experiments
