#pragma once

#include <map>
#include <vector>

#include "core/deadlock/waits_for.h"

namespace armloom {

struct Urgency {
  JobId job;
  int priority;
};

// Priorities without inversion: a job that others wait for, directly or through others, is as
// urgent as the most urgent of them. Every job of `jobs` with the larger of its own priority and
// that of any that waits for it in `graph`; jobs of the graph that are not in `jobs` only pass on.
// n log n.
[[nodiscard]] std::map<JobId, int> effective_priorities(const WaitsFor& graph,
                                                        std::vector<Urgency> jobs);

}  // namespace armloom
