// mesh_bench [--benchmark_...] [CELL.json ...]
// Checked states of two arms with meshes. Names are "decided_<question>/<cell>/<states>".
#include <benchmark/benchmark.h>

#include <filesystem>
#include <span>
#include <string>

#include "core/collision/filter/kernel.h"
#include "core/collision/state/clearance_query.h"
#include "test/bench/mesh_cells.h"
#include "test/bench/run_benchmarks.h"

namespace armloom::bench {
namespace {

constexpr std::size_t kStates = 2048;

// Measures the time per state. Eight states are checked at once.
void decided(benchmark::State& run, const PlanningScenePtr& scene,
             const std::vector<Configuration>& states, const PairLimits& limits) {
  ClearanceQuery check(scene, limits);
  std::vector<const Configuration*> eight(filter::kLanes);
  std::size_t next = 0;
  double close = 0.0;
  double asked = 0.0;
  while (run.KeepRunningBatch(filter::kLanes)) {
    for (const Configuration*& q : eight) q = &states[next++ % states.size()];
    close += __builtin_popcount(check.too_close(eight));
    asked += filter::kLanes;
  }
  run.counters["not_clear_percent"] = 100.0 * close / asked;
}

// Measures the time of the monitor's query: the closest pair within the horizon.
void closest(benchmark::State& run, const PlanningScenePtr& scene,
             const std::vector<Configuration>& states, double horizon_m) {
  ClearanceQuery checker(scene);
  std::size_t next = 0;
  for (auto _ : run) {
    benchmark::DoNotOptimize(checker.closest_apart(states[next++ % states.size()], horizon_m));
  }
}

void register_cell(const std::string& name, const CellPtr& cell) {
  const PlanningScenePtr scene = PlanningScene::build(cell).value();
  for (const bool near : {false, true}) {
    const auto states = random_states(*cell, kStates, near);
    const std::string row = "/" + name + (near ? "/near" : "/anywhere");
    benchmark::RegisterBenchmark(("decided_contact" + row).c_str(), [=](auto& run) {
      decided(run, scene, states, {0.0, 0.0});
    });
    benchmark::RegisterBenchmark(("decided_clearance" + row).c_str(), [=](auto& run) {
      decided(run, scene, states,
              {cell->clearances.clearance_m, cell->clearances.self_clearance_m});
    });
    benchmark::RegisterBenchmark(("closest_below_0.1m" + row).c_str(),
                                 [=](auto& run) { closest(run, scene, states, 0.1); });
    benchmark::RegisterBenchmark(("closest_below_1m" + row).c_str(),
                                 [=](auto& run) { closest(run, scene, states, 1.0); });
  }
}

}  // namespace
}  // namespace armloom::bench

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  const std::span<char*> files(argv + 1, static_cast<std::size_t>(argc) - 1);
  for (const std::string file : files) {
    if (file.starts_with("-")) return benchmark::ReportUnrecognizedArguments(argc, argv), 2;
    armloom::bench::register_cell(std::filesystem::path(file).stem(),
                                  armloom::bench::cell_of_file(file));
  }
  if (files.empty()) {
    armloom::bench::register_cell("two_shuttles", armloom::bench::two_shuttles());
    armloom::bench::register_cell("two_channel_arms", armloom::bench::two_channel_arms());
  }
  return armloom::bench::run_benchmarks();
}
