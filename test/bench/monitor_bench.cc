// monitor_bench [ROUNDS]
// Measures what the monitor costs with eight arms in motion: processor time from the beginning to
// the end of each monitor period, as a share of one core at its rate. Simulated time.
#include <time.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <numeric>
#include <vector>

#include "core/executive/simulation.h"
#include "test/bench/cells.h"

namespace armloom::bench {
namespace {

double processor_us() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

struct Watch final : Observer {
  void on_event(const Event& event) override {
    findings += std::holds_alternative<MonitorEvent>(event.body) ? 1 : 0;
  }
  void on_tick(TimePoint, const Configuration&) override {}
  void on_watch() override { began_us = processor_us(); }
  void on_state(const StateFrame& frame) override {
    if (frame.motions.size() < 8) return;
    costs_us.push_back(processor_us() - began_us);
  }
  double began_us = 0.0;
  std::vector<double> costs_us;  // of the periods in which all arms have a motion
  int findings = 0;
};

// Each arm turns its joints by a part of a radian and back.
JobRequest swing(const Cell& cell, const Arm& arm, int round) {
  JobRequest request{.key = arm.name + "-" + std::to_string(round), .name = "", .trajectory = {}};
  std::vector<double> from, to, zero(arm.joints.size(), 0.0);
  for (std::size_t j = 0; j < arm.joints.size(); ++j) {
    request.trajectory.joint_names.push_back(cell.joint(arm.joints[j]).name);
    from.push_back(arm.home[static_cast<Eigen::Index>(j)]);
    to.push_back(from.back() + (j % 2 == 0 ? 0.25 : -0.15));
  }
  if (round % 2 == 1) std::swap(from, to);
  request.trajectory.points = {{from, zero, zero, 0.0}, {to, zero, zero, 2.0}};
  return request;
}

void measure(const std::string& policy, double rate_hz, int rounds) {
  auto cell = std::make_shared<Cell>(*line_of_pandas(8, 0.9));
  cell->monitor.rate_hz = rate_hz;
  Watch watch;
  auto simulation = Simulation::create(cell, {.policy = policy}, watch);
  if (!simulation) throw std::runtime_error(simulation.error().front().detail);
  for (int round = 0; round < rounds; ++round) {
    for (const Arm& arm : cell->arms) {
      const auto job = (*simulation)->executive().submit(swing(*cell, arm, round));
      if (!job) throw std::runtime_error(job.error().front().detail);
    }
  }
  const TimePoint limit{std::chrono::seconds(10 * rounds)};
  while (!(*simulation)->executive().all_ended() && (*simulation)->now() < limit) {
    (*simulation)->tick();
  }
  auto& costs = watch.costs_us;
  if (costs.empty()) throw std::runtime_error("the arms never moved together");
  const double mean =
      std::accumulate(costs.begin(), costs.end(), 0.0) / static_cast<double>(costs.size());
  std::ranges::sort(costs);
  const double most = costs[costs.size() * 999 / 1000];
  std::printf(
      "%-16s %6.0f Hz %8zu periods  mean %7.1f us  p99.9 %7.1f us  %5.1f %% of a core  %d "
      "findings\n",
      policy.c_str(), rate_hz, costs.size(), mean, most, 1e-4 * mean * rate_hz, watch.findings);
}

}  // namespace
}  // namespace armloom::bench

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 10;
  try {
    for (const char* policy : {"certified", "timed_discrete"}) {
      for (const double rate_hz : {250.0, 1000.0}) {
        armloom::bench::measure(policy, rate_hz, rounds);
      }
    }
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
  return 0;
}
