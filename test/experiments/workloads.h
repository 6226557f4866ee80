#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "test/experiments/job_maker.h"

namespace armloom::experiments {

// A workload of README.md in this folder, drawn for one seed.
struct Workload {
  CellPtr cell;
  std::vector<PlannedJob> jobs;
  // The same tasks for the first arm alone; empty if not part of this workload.
  std::vector<PlannedJob> one_arm;
};

struct WorkloadKind {
  std::string name;
  std::string title;
  // True if asynchronous execution is expected to gain: only these workloads have claims about
  // gains. The others show where it does not gain.
  bool pays;
  Workload (*make)(std::uint64_t seed);
  // Some jobs are late and slow, unknown to the optimum.
  bool delayed = false;
  // The workload with the same jobs but without choices for the scheduler; its optimum and bounds
  // apply. Empty if there is none.
  std::string freed_from = {};
};

// Throw std::runtime_error if a cell cannot be read or no open task is found.
[[nodiscard]] const std::vector<WorkloadKind>& workload_kinds();
// Precondition: a workload of this name exists.
[[nodiscard]] const WorkloadKind& workload_kind(const std::string& name);

}  // namespace armloom::experiments
