// Benchmarks of FCL the MoveIt way (moveit_way.h) and of the engine, on one thread. First checks
// the workloads, and compares the baseline with exact shapes. Exit code 1 if the baseline misses a
// contact.
#include "test/bench/collision_bench.h"

#include <benchmark/benchmark.h>

#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>

#include "test/bench/moveit_way.h"
#include "test/bench/run_benchmarks.h"

namespace armloom::bench {
namespace {

// Throws if the baseline misses an exact contact.
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

void tell_distance(const std::string& name, const Motions& motions) {
  ExactScene exact(motions.cell);
  const double closest_m =
      closest_in_band(exact, motions, {std::chrono::milliseconds(5)}, 1.0, 0.0);
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
    register_engine(workloads);
    return run_benchmarks();
  } catch (const std::exception& failed) {
    std::fprintf(stderr, "collision_bench: %s\n", failed.what());
    return 1;
  }
}
