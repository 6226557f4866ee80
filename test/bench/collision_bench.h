#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "test/bench/motions.h"
#include "test/bench/states.h"
#include "test/bench/workloads.h"

namespace armloom::bench {

// One class of combined states of one cell.
struct States {
  CellPtr cell;
  std::vector<Configuration> all;
};

// Everything that is measured; lives for the whole run.
struct Workloads {
  std::map<std::string, States> states;    // apart, near, touching, eight_arms
  std::map<std::string, Motions> motions;  // clear, crossing
  std::map<std::size_t, Hall> halls;       // by the number of other arms
};

// Creates all workloads; throws std::runtime_error if one does not meet its claim. Takes two
// seconds.
[[nodiscard]] Workloads make_workloads();

// Each adds its benchmarks, named "<way>/<workload>". The workloads must outlive the run. An
// iteration is one state (in turn) or one admission.
void register_moveit_way(const Workloads& workloads);
void register_engine(const Workloads& workloads);

}  // namespace armloom::bench
