#pragma once

#include <string>
#include <vector>

#include "test/experiments/figures.h"

namespace armloom::experiments {

struct Plan {
  std::vector<WorkloadKind> workloads;
  std::vector<std::string> policies;
  std::uint64_t seeds = 20;  // 1, 2, ...
  unsigned threads = 1;      // each run stays on one
};

struct Results {
  std::vector<RunRow> rows;  // by workload, seed and policy, as planned; one arm first
};
// Every policy on the same jobs. The same rows for any number of threads, but for judging_s. Says
// on stderr which seed of which workload is done. Throws what a run throws.
[[nodiscard]] Results run_all(const Plan& plan);

}  // namespace armloom::experiments
