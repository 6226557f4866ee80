#pragma once

#include <map>
#include <vector>

#include "core/deadlock/waits_for.h"

namespace armloom {

struct Urgency {
  JobId job;
  int priority;
};

// Returns effective priorities without inversion (priority inheritance): each job of `jobs` gets
// the largest priority of itself and of all jobs that wait for it in `graph`, directly or through
// others. Jobs of the graph that are not in `jobs` only pass priorities on. O(n log n).
[[nodiscard]] std::map<JobId, int> effective_priorities(const WaitsFor& graph,
                                                        std::vector<Urgency> jobs);

}  // namespace armloom
