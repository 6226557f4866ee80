// Arms start late, run slowly, stall and report late at random. ARMLOOM_SEEDS=500 runs more.
#include <gtest/gtest.h>

#include "test/scenarios/random_faults.h"
#include "test/scenarios/seeds.h"
#include "test/scenarios/star.h"

namespace armloom {
namespace {

constexpr std::uint64_t kSeeds = 25;

struct SlidersRun : DelayedRun {
  double smallest_m = 1e9;
  double when_s = 0.0;
};

SlidersRun run(std::uint64_t seed, std::size_t arms, const std::string& policy) {
  Random random(seed);
  CellDescription description = star(arms);
  description.scheduling.backlog_timeout = 1h;
  description.execution.duration_margin = 1h;  // no job fails for resting long
  auto cell = build_cell(description);
  SmallestDistance closest(arms);
  auto created = Simulation::create(*cell, ExecutiveOptions{.policy = policy}, closest);
  Simulation& simulation = **created;
  Executive& executive = simulation.executive();
  simulation.tick();
  for (std::size_t i = 0; i < arms; ++i) {
    delay_at_random(executive, std::string(1, static_cast<char>('a' + i)), 20.0, random,
                    kFarBeyond);
  }
  // Returns a motion back and forth through the crossing, with or without pauses. It never rests in
  // the crossing.
  std::vector<std::string> keys;
  std::vector<double> stands(arms, -1.0);
  const bool paused = random.chance(0.5);
  for (std::size_t n = 0; n < 3 * arms; ++n) {
    const std::size_t i = n % arms;
    const double to = (stands[i] < 0 ? 1.0 : -1.0) * random.uniform(0.7, 1.2);
    const auto view = executive.submit(
        slide(std::string(1, static_cast<char>('a' + i)), stands[i], to, random.uniform(2.4, 5.0)));
    EXPECT_TRUE(view);
    if (!view) continue;
    keys.push_back(view->key);
    stands[i] = to;
    if (paused) simulation.run_until(simulation.now() + from_seconds(random.uniform(0.0, 2.0)));
  }
  while (!executive.all_ended() && simulation.now() < at(1h)) simulation.tick();
  SlidersRun outcome;
  outcome.read(executive, keys);
  outcome.smallest_m = closest.smallest_m;
  outcome.when_s = to_seconds(closest.when);
  return outcome;
}

class RandomDelays : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Policies, RandomDelays,
                         ::testing::Values("sequential", "lockstep", "reservation", "certified",
                                           "earliest_start", "coordinated"));

TEST_P(RandomDelays, NeverCauseContactAndEveryJobSucceeds) {
  double smallest_m = 1e9;
  std::uint64_t stops = 0, jobs = 0;
  for (std::uint64_t seed = 1; seed <= seed_count(kSeeds); ++seed) {
    const std::size_t arms = 2 + seed % 3;
    const SlidersRun outcome = run(seed, arms, GetParam());
    EXPECT_GT(outcome.smallest_m, 0.0)
        << "seed " << seed << ", " << arms << " arms, contact at " << outcome.when_s << " s";
    EXPECT_TRUE(outcome.all_ended) << "seed " << seed << ", " << arms << " arms: jobs hang";
    EXPECT_EQ(outcome.succeeded, outcome.jobs) << "seed " << seed << ": " << outcome.first_other;
    smallest_m = std::min(smallest_m, outcome.smallest_m);
    stops += outcome.monitor_stops;
    jobs += outcome.jobs;
  }
  std::cout << GetParam() << ": " << seed_count(kSeeds) << " seeds, " << jobs << " jobs, closest "
            << smallest_m << " m, " << stops << " monitor stops\n";
}

}  // namespace
}  // namespace armloom
