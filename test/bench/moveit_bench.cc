#include <benchmark/benchmark.h>

#include "test/bench/collision_bench.h"
#include "test/bench/moveit_way.h"

namespace armloom::bench {
namespace {

void per_state(benchmark::State& run, const States& states) {
  MoveItWay moveit(states.cell);
  std::size_t next = 0;
  for (auto _ : run) {
    benchmark::DoNotOptimize(moveit.in_collision(states.all[next]));
    next = next + 1 == states.all.size() ? 0 : next + 1;
  }
}

// One iteration is the whole motion, every `step`, until the first collision. MoveIt always checks
// arms, scene and self.
void per_admission(benchmark::State& run, const Motions& motions, Duration step) {
  MoveItWay moveit(motions.cell);
  Configuration q;
  const Duration end = motions.trajectories.at(0)->duration();
  std::size_t instants = 0;
  bool collision = false;
  for (auto _ : run) {
    collision = false;
    instants = 0;
    for (Duration t{0}; t <= end && !collision; t += step) {
      motions.state_at(t, q);
      collision = moveit.in_collision(q);
      ++instants;
    }
    benchmark::DoNotOptimize(collision);
  }
  if (collision) run.SkipWithError("the MoveIt way calls a free motion a collision");
  run.counters["instants"] = static_cast<double>(instants);
}

}  // namespace

void register_moveit_way(const Workloads& workloads) {
  for (const auto& [others, hall] : workloads.halls) {
    benchmark::RegisterBenchmark(
        ("moveit_way/hall/others:" + std::to_string(others) + "/dt_ms:100").c_str(),
        [&m = hall.motions](benchmark::State& run) {
          per_admission(run, m, std::chrono::milliseconds(100));
        })
        ->Unit(benchmark::kMillisecond);
  }
  for (const auto& [name, states] : workloads.states) {
    benchmark::RegisterBenchmark(("moveit_way/" + name).c_str(), [&s = states](
                                                                     benchmark::State& run) {
      per_state(run, s);
    })->Unit(benchmark::kMicrosecond);
  }
  for (const auto& [name, motions] : workloads.motions) {
    for (const int step_ms : {10, 100}) {
      benchmark::RegisterBenchmark(
          ("moveit_way/admission_" + name + "/dt_ms:" + std::to_string(step_ms)).c_str(),
          [&m = motions, step_ms](benchmark::State& run) {
            per_admission(run, m, std::chrono::milliseconds(step_ms));
          })
          ->Unit(benchmark::kMillisecond);
    }
  }
}

}  // namespace armloom::bench
