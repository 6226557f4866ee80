#pragma once

#include <string>
#include <vector>

#include "test/experiments/figures.h"

namespace armloom::experiments {

struct Plan {
  std::vector<WorkloadKind> workloads;
  std::vector<std::string> policies;
  std::uint64_t seeds = 20;  // uses the seeds 1 to `seeds`
  unsigned threads = 1;      // each run uses one thread
};

struct Results {
  std::vector<RunRow> rows;  // by workload, seed and policy, as planned; one arm first
};
// Runs every policy on the same jobs. Independent of the number of threads, except judging_s.
// Reports progress on stderr. Throws what a run throws.
[[nodiscard]] Results run_all(const Plan& plan);

}  // namespace armloom::experiments
