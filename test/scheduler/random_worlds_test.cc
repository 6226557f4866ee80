// Whole workloads without geometry, under every policy: arms that share places by a table, are
// late, slow and stall; jobs that are canceled, arms that are stopped, scenes that change. What has
// to hold after every step is claimed by IdealArms.
#include <gmock/gmock.h>

#include "test/scenarios/seeds.h"
#include "test/scheduler/random_world.h"

namespace armloom {
namespace {

std::string waits_text(const Wait& wait) {
  return std::string(", waits for ") + to_string(wait.kind) +
         (wait.job ? " " + std::to_string(wait.job->value()) : "") +
         (wait.arm ? " of arm " + std::to_string(wait.arm->value()) : "");
}

class Worlds : public ::testing::TestWithParam<std::string> {
 protected:
  static bool is_timed() { return GetParam() == "timed_discrete"; }

  // How many jobs have ended in each way, over all seeds.
  std::map<JobState, int> run(std::uint64_t usual, Disturbances disturbances, bool all_succeed) {
    std::map<JobState, int> ended;
    for (std::uint64_t seed = 1; seed <= seed_count(usual); ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      World world(seed, GetParam(), disturbances);
      world.run();
      IdealArms& bench = world.bench();
      for (const JobId job : world.jobs) {
        const Job& at_end = bench.job(job);
        ++ended[at_end.state()];
        EXPECT_TRUE(is_terminal(at_end.state()))
            << "job " << job.value() << " is " << to_string(at_end.state())
            << (at_end.times.started_at ? ", has begun" : "")
            << (at_end.waits_on.empty() ? "" : waits_text(at_end.waits_on.front()));
        EXPECT_TRUE(!all_succeed || at_end.state() == JobState::succeeded)
            << "job " << job.value() << " is " << to_string(at_end.state()) << ": "
            << at_end.detail();
        EXPECT_EQ(bench.terminal_events[job], 1);
        EXPECT_GE(bench.times_dispatched(job), bench.times_released(job));
        EXPECT_EQ(bench.times_dispatched(job) > 0, bench.times_released(job) > 0);
      }
      if (HasFailure()) break;
    }
    return ended;
  }
};
INSTANTIATE_TEST_SUITE_P(Policies, Worlds, ::testing::ValuesIn(policy_names()),
                         [](const auto& policy) { return policy.param; });

TEST_P(Worlds, WhatCanBeDoneInTurnIsDone) {
  EXPECT_GT(run(200, {}, true)[JobState::succeeded], 1000);
}

// timed_discrete promises it for times that are kept.
TEST_P(Worlds, WhatCanBeDoneInTurnIsDoneHoweverLateArmsAre) {
  EXPECT_GT(run(200, {.delays = true}, !is_timed())[JobState::succeeded], 1000);
}

TEST_P(Worlds, WhatIsStoppedGoesOn) {
  EXPECT_GT(run(200, {.pauses = true}, !is_timed())[JobState::succeeded], 1000);
}

TEST_P(Worlds, WhatIsStoppedLateGoesOn) {
  EXPECT_GT(run(200, {.delays = true, .pauses = true}, !is_timed())[JobState::succeeded], 1000);
}

TEST_P(Worlds, WhoeverIsStoppedWhatCanBeDoneInTurnIsDone) {
  EXPECT_GT(run(200, {.delays = true, .stops = true}, !is_timed())[JobState::succeeded], 1000);
}

TEST_P(Worlds, WhateverIsCanceledEveryJobEndsOnce) {
  auto ended = run(200, {.delays = true, .stops = true, .cancels = true}, false);
  EXPECT_GT(ended[JobState::canceled], 50);
}

TEST_P(Worlds, OnScenesThatChangeEveryJobEndsOnce) {
  auto ended = run(200, {.delays = true, .stops = true, .cancels = true, .scenes = true}, false);
  EXPECT_GT(ended[JobState::succeeded], 500);
}

TEST_P(Worlds, WhateverIsGivenAnotherPriorityWhatCanBeDoneInTurnIsDone) {
  auto ended = run(200, {.delays = true, .amends = true, .choices = true}, !is_timed());
  EXPECT_GT(ended[JobState::succeeded], 1000);
}

TEST_P(Worlds, WhateverIsAmendedAndCanceledEveryJobEndsOnce) {
  auto ended = run(
      200, {.delays = true, .stops = true, .cancels = true, .parks = true, .amends = true}, false);
  EXPECT_GT(ended[JobState::succeeded], 500);
}

TEST_P(Worlds, WhereArmsGoAsideEveryJobEndsOnce) {
  auto ended = run(200, {.delays = true, .cancels = true, .parks = true}, false);
  EXPECT_GT(ended[JobState::succeeded], 500);
}

// Of jobs in any order, and of jobs that any of several arms can do.
TEST_P(Worlds, WhatMayBeChosenIsDoneToo) {
  EXPECT_GT(run(200, {.delays = true, .choices = true}, !is_timed())[JobState::succeeded], 1000);
}

// The one of 3,000 worlds where a job is given to an arm behind one that waits for another arm,
// whose next job would then be in its way for good: a ring, that its other arm opens.
TEST(World, WhatWouldWaitForEverOnItsArmIsDoneByAnotherOne) {
  World world(2351, "lockstep", {.delays = true, .choices = true});
  world.run();
  ASSERT_GT(world.jobs.size(), 5u);
  for (const JobId job : world.jobs) {
    EXPECT_EQ(world.bench().state(job), JobState::succeeded) << world.bench().job(job).detail();
  }
}

TEST_P(Worlds, WhateverIsCanceledOfWhatMayBeChosenEveryJobEndsOnce) {
  auto ended = run(200,
                   {.delays = true,
                    .stops = true,
                    .cancels = true,
                    .scenes = true,
                    .parks = true,
                    .choices = true},
                   false);
  EXPECT_GT(ended[JobState::succeeded], 500);
}

// Jobs that nobody says can be done, to places, by any arm, brought to their starts: when nothing
// happens any more, nobody waits.
TEST_P(Worlds, EveryWaitEnds) {
  auto ended = run(220, {.delays = true, .cancels = true, .goals = true, .crowds = true}, false);
  EXPECT_GT(ended[JobState::succeeded], 500);
}

TEST_P(Worlds, EveryWaitEndsWhereArmsGoAside) {
  auto ended = run(
      220, {.delays = true, .cancels = true, .parks = true, .goals = true, .crowds = true}, false);
  EXPECT_GT(ended[JobState::succeeded], 500);
}

TEST_P(Worlds, EveryWaitEndsWhateverIsStoppedAndAmended) {
  auto ended = run(220,
                   {.delays = true,
                    .stops = true,
                    .cancels = true,
                    .scenes = true,
                    .parks = true,
                    .amends = true,
                    .choices = true,
                    .goals = true,
                    .crowds = true},
                   false);
  EXPECT_GT(ended[JobState::succeeded], 500);
}

}  // namespace
}  // namespace armloom
