// The collision benchmarks: FCL the MoveIt way beside the engine, one run, one thread. Before the
// first of them the workloads are made and checked, and the baseline against the exact shapes: it
// must report every contact that these have, else the run ends with exit code 1.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <exception>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "test/bench/cells.h"
#include "test/bench/moveit_way.h"
#include "test/bench/states.h"
#include "test/bench/workloads.h"

namespace armloom::bench {
namespace {

constexpr std::size_t kStates = 1024;
constexpr std::size_t kCircleStates = 256;

// One class of combined states of one cell.
struct States {
  CellPtr cell;
  std::vector<Configuration> all;
};

// Everything that is timed; lives for the whole run.
struct Workloads {
  std::map<std::string, States> states;    // apart, near, touching, eight_arms
  std::map<std::string, Motions> motions;  // clear, crossing
  std::map<std::size_t, Hall> halls;       // by the number of other arms
};

Workloads make_workloads() {
  Workloads made;
  const CellPtr pandas = two_pandas();
  Referees referees(pandas);
  StateClasses classes = classed_states(referees, kStates);
  made.states["apart"] = {pandas, std::move(classes.apart)};
  made.states["near"] = {pandas, std::move(classes.near)};
  made.states["touching"] = {pandas, std::move(classes.touching)};
  const CellPtr circle = circle_of_pandas(8, 1.0);
  Referees circle_referees(circle);
  made.states["eight_arms"] = {circle, free_states(circle_referees, kCircleStates)};
  made.motions["clear"] = clear_pair();
  made.motions["crossing"] = crossing_pair();
  for (const std::size_t others : {1U, 3U, 7U, 15U}) made.halls.emplace(others, hall(others));
  return made;
}

// How the baseline's answers compare with the exact ones; throws if it misses a contact.
void compare_with_exact(const std::string& name, const States& states) {
  ExactScene exact(states.cell);
  MoveItWay moveit(states.cell);
  std::size_t contacts = 0;
  std::size_t reported = 0;
  for (const Configuration& q : states.all) {
    const bool contact = exact.in_contact(q);
    const bool report = moveit.in_collision(q);
    if (contact && !report) throw std::runtime_error(name + ": the MoveIt way misses a contact");
    contacts += contact ? 1 : 0;
    reported += report ? 1 : 0;
  }
  std::fprintf(stderr,
               "%-10s %4zu states, %4zu in contact, %4zu reported by the MoveIt way (%zu "
               "meshes, %zu triangles)\n",
               name.c_str(), states.all.size(), contacts, reported, moveit.meshes(),
               moveit.triangles());
}

// How close the arms come, exactly, every 5 ms.
void tell_distance(const std::string& name, const Motions& motions) {
  ExactScene exact(motions.cell);
  const double closest_m =
      closest_in_band(exact, motions, std::chrono::milliseconds(5), Duration{0}, 1.0, 0.0);
  std::fprintf(stderr, "%-10s %4zu motions, %.1f mm apart at the closest\n", name.c_str(),
               motions.trajectories.size(), 1e3 * closest_m);
}

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

// One iteration: one state, in turn.
void per_state(benchmark::State& run, const States& states) {
  MoveItWay moveit(states.cell);
  std::size_t next = 0;
  for (auto _ : run) {
    benchmark::DoNotOptimize(moveit.in_collision(states.all[next]));
    next = next + 1 == states.all.size() ? 0 : next + 1;
  }
}

// One iteration: the whole motion, at every `step` from its beginning to its end, ended early by
// the first collision. MoveIt's check is always complete: arms, scene and self.
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

}  // namespace
}  // namespace armloom::bench

int main(int argc, char** argv) {
  using namespace armloom::bench;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  try {
    const Workloads workloads = make_workloads();
    std::fprintf(stderr, "processor: %s\n", processor().c_str());
    for (const auto& [name, states] : workloads.states) compare_with_exact(name, states);
    for (const auto& [name, motions] : workloads.motions) tell_distance(name, motions);
    register_moveit_way(workloads);
    benchmark::RunSpecifiedBenchmarks();
  } catch (const std::exception& failed) {
    std::fprintf(stderr, "collision_bench: %s\n", failed.what());
    return 1;
  }
}
