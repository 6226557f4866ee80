// Arms that start late, run slowly and stall at random: whatever their delays, arms never touch and
// every job succeeds. The measured distance is asked of the engine at every tick.
#include <gtest/gtest.h>

#include <random>

#include "test/scenarios/star.h"

namespace armloom {
namespace {

constexpr std::uint64_t kSeeds = 60;

struct Outcome {
  double smallest_m = 1e9;
  double when_s = 0.0;
  std::size_t jobs = 0, succeeded = 0;
  bool all_ended = false;
  std::uint64_t monitor_stops = 0;
  std::string first_other;
};

Outcome run(std::uint64_t seed, std::size_t arms, const std::string& policy) {
  std::mt19937_64 random(seed);
  const auto uniform = [&random](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  auto cell = build_cell(star(arms));
  SmallestDistance closest(arms);
  auto created = Simulation::create(*cell, ExecutiveOptions{.policy = policy}, closest);
  Simulation& simulation = **created;
  Executive& executive = simulation.executive();
  simulation.tick();
  for (std::size_t i = 0; i < arms; ++i) {
    const std::string arm(1, static_cast<char>('a' + i));
    const auto inject = [&](FaultRequest fault) { EXPECT_TRUE(executive.inject(fault)); };
    inject({.arm = arm, .kind = ArmFault::Kind::late_start, .value = uniform(0.0, 2.0)});
    inject({.arm = arm, .kind = ArmFault::Kind::slow, .value = uniform(0.3, 1.0)});
    for (int stall = 0; stall < 3; ++stall) {
      inject({.arm = arm,
              .kind = ArmFault::Kind::stall,
              .at = at(from_seconds(uniform(0.0, 20.0))),
              .lasting = from_seconds(uniform(0.1, 3.0))});
    }
  }
  // Back and forth through the crossing, never to rest in it, one after the other or with pauses.
  std::vector<std::string> keys;
  std::vector<double> stands(arms, -1.0);
  const bool paused = uniform(0.0, 1.0) < 0.5;
  for (std::size_t n = 0; n < 3 * arms; ++n) {
    const std::size_t i = n % arms;
    const double to = (stands[i] < 0 ? 1.0 : -1.0) * uniform(0.7, 1.2);
    const auto view = executive.submit(
        slide(std::string(1, static_cast<char>('a' + i)), stands[i], to, uniform(2.4, 5.0)));
    EXPECT_TRUE(view);
    if (!view) continue;
    keys.push_back(view->key);
    stands[i] = to;
    if (paused) simulation.run_until(simulation.now() + from_seconds(uniform(0.0, 2.0)));
  }
  while (!executive.all_ended() && simulation.now() < at(600s)) simulation.tick();
  Outcome outcome{closest.smallest_m, to_seconds(closest.when), keys.size()};
  outcome.all_ended = executive.all_ended();
  outcome.monitor_stops = executive.figures().monitor_stops;
  for (const std::string& key : keys) {
    const JobView job = *executive.job(key);
    if (job.state == JobState::succeeded) {
      ++outcome.succeeded;
    } else if (outcome.first_other.empty()) {
      outcome.first_other = key + " " + to_string(job.state) + " " + job.detail;
    }
  }
  return outcome;
}

class RandomDelays : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Policies, RandomDelays,
                         ::testing::Values("certified", "earliest_start", "coordinated"));

TEST_P(RandomDelays, TouchNobodyAndEveryJobSucceeds) {
  double smallest_m = 1e9;
  std::uint64_t stops = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const std::size_t arms = 2 + seed % 3;
    const Outcome outcome = run(seed, arms, GetParam());
    EXPECT_GT(outcome.smallest_m, 0.0)
        << "seed " << seed << ", " << arms << " arms, contact at " << outcome.when_s << " s";
    EXPECT_TRUE(outcome.all_ended) << "seed " << seed << ", " << arms << " arms: jobs hang";
    EXPECT_EQ(outcome.succeeded, outcome.jobs) << "seed " << seed << ": " << outcome.first_other;
    smallest_m = std::min(smallest_m, outcome.smallest_m);
    stops += outcome.monitor_stops;
  }
  RecordProperty("smallest_m", std::to_string(smallest_m));
  RecordProperty("monitor_stops", std::to_string(stops));
  std::cout << GetParam() << ": closest " << smallest_m << " m, " << stops << " monitor stops\n";
}

}  // namespace
}  // namespace armloom
