#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "test/experiments/job_maker.h"

namespace armloom::experiments {

// What README.md beside this file describes, drawn for one seed.
struct Workload {
  CellPtr cell;
  std::vector<PlannedJob> jobs;
  // The same tasks for the first arm alone; empty: not asked of this workload.
  std::vector<PlannedJob> one_arm;
};

struct WorkloadKind {
  std::string name;
  std::string title;
  // Whether asynchronous execution is expected to pay: the claims about what it gains are asked of
  // these only. The others are there to show where it does not.
  bool pays;
  Workload (*make)(std::uint64_t seed);
  // Some jobs are late and slow: the optimum knows of none.
  bool delayed = false;
  // The workload whose jobs these are, but for what the scheduler may choose itself: the optimum
  // and the bounds are of that one. Empty: none.
  std::string freed_from = {};
};

// Throw std::runtime_error when a cell does not read, or no open task is found.
[[nodiscard]] const std::vector<WorkloadKind>& workload_kinds();
// Precondition: there is one of this name.
[[nodiscard]] const WorkloadKind& workload_kind(const std::string& name);

}  // namespace armloom::experiments
