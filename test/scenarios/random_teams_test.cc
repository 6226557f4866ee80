// Jobs of one to three arms in cells of three and four arms, with random delays, commands and
// faults. A job that never ends must wait for an arm without a job. ARMLOOM_SEEDS=500 runs more;
// ARMLOOM_TOLD=<seed> runs that seed only and prints its events.
#include <gtest/gtest.h>

#include <iostream>

#include "test/scenarios/seeds.h"
#include "test/scenarios/team_run.h"

namespace armloom {
namespace {

constexpr std::uint64_t kSeeds = 80;          // under `coordinated`
constexpr std::uint64_t kSeedsOfOthers = 25;  // under each other policy

class RandomTeams : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Policies, RandomTeams,
                         ::testing::Values("coordinated", "earliest_start", "certified",
                                           "reservation", "lockstep", "sequential"));

TEST_P(RandomTeams, NeverTouchAndEveryJobEndsOnce) {
  const std::string policy = GetParam();
  TeamTally tally;
  std::uint64_t first = 1, last = seed_count(policy == "coordinated" ? kSeeds : kSeedsOfOthers);
  if (const char* only = std::getenv("ARMLOOM_TOLD"))
    first = last = std::strtoull(only, nullptr, 10);
  for (std::uint64_t seed = first; seed <= last; ++seed) {
    SCOPED_TRACE(policy + ", seed " + std::to_string(seed));
    TeamsRun(seed, policy).run(tally);
  }
  std::cout << policy << ": " << last + 1 - first << " seeds, " << tally.jobs << " jobs, "
            << tally.own << " of them the server's own, " << tally.succeeded
            << " succeeded, closest " << tally.smallest_m << " m, with arms that gave up "
            << tally.smallest_fault_m << " m, in step " << tally.smallest_in_step_m << " m, "
            << tally.monitor_stops << " monitor stops\n";
}

}  // namespace
}  // namespace armloom
