#pragma once

#include <map>
#include <vector>

#include "core/deadlock/waits_for.h"

namespace armloom {

struct Urgency {
  JobId job;
  int priority;
};

// Returns effective priorities (priority inheritance): for each of `jobs`, the largest of its own
// priority and the priorities of all jobs that wait for it in `graph`, directly or through others.
// Jobs of the graph that are not in `jobs` only pass priorities on. O(n log n).
[[nodiscard]] std::map<JobId, int> effective_priorities(const WaitsFor& graph,
                                                        std::vector<Urgency> jobs);

}  // namespace armloom
