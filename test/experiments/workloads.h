#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "test/experiments/job_maker.h"

namespace armloom::experiments {

// A workload of README.md, drawn for one seed.
struct Workload {
  CellPtr cell;
  std::vector<PlannedJob> jobs;
  // The tasks for the first arm alone; empty if not needed.
  std::vector<PlannedJob> one_arm;
};

struct WorkloadKind {
  std::string name;
  std::string title;
  // Claims about gains apply. The other workloads show where asynchronous execution does not gain.
  bool pays;
  Workload (*make)(std::uint64_t seed);
  // Some jobs are late and slow.
  bool delayed = false;
  // Name of the same workload without choices for the scheduler. Its optimum and bounds apply here.
  // Empty if there is none.
  std::string freed_from = {};
  // Jobs with steps: their paths are planned in the run, so there is no bound and no optimum.
  bool of_tasks = false;
};

// Throw std::runtime_error if a cell cannot be read or no open task is found.
[[nodiscard]] const std::vector<WorkloadKind>& workload_kinds();
[[nodiscard]] const WorkloadKind& workload_kind(const std::string& name);

}  // namespace armloom::experiments
