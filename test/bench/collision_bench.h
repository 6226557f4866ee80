#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "test/bench/motions.h"
#include "test/bench/states.h"
#include "test/bench/workloads.h"

namespace armloom::bench {

struct States {
  CellPtr cell;
  std::vector<Configuration> all;
};

struct Workloads {
  std::map<std::string, States> states;    // apart, near, touching, eight_arms
  std::map<std::string, Motions> motions;  // clear, crossing
  std::map<std::size_t, Hall> halls;       // by the number of other arms
};

// Throws std::runtime_error if a workload does not meet its claim; takes two seconds.
[[nodiscard]] Workloads make_workloads();

// These functions register benchmarks named "<way>/<workload>". One iteration is one state or one
// admission. `workloads` must exist until the benchmarks have run.
void register_moveit_way(const Workloads& workloads);
void register_engine(const Workloads& workloads);

}  // namespace armloom::bench
