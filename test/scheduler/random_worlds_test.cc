// Complete workloads without geometry under every policy, with late, slow and stalling arms,
// cancels, stops and scene changes. IdealArms checks the invariants.
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

class RandomWorlds : public ::testing::TestWithParam<std::string> {
 protected:
  static bool is_timed() { return GetParam() == "timed_discrete"; }

  std::map<JobState, int> run(std::uint64_t usual, Disturbances disturbances, bool all_succeed) {
    std::map<JobState, int> ended;
    for (std::uint64_t seed = 1; seed <= seed_count(usual); ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      World world(seed, GetParam(), disturbances);
      world.run();
      IdealArms& bench = world.bench();
      for (const JobId job : world.jobs) {
        const Step& at_end = bench.job(job);
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
INSTANTIATE_TEST_SUITE_P(Policies, RandomWorlds, ::testing::ValuesIn(policy_names()),
                         [](const auto& policy) { return policy.param; });

TEST_P(RandomWorlds, FeasibleJobsSucceed) {
  EXPECT_GT(run(200, {}, true)[JobState::succeeded], 1000);
}

// timed_discrete guarantees this only for punctual arms.
TEST_P(RandomWorlds, FeasibleJobsSucceedOnLateArms) {
  EXPECT_GT(run(200, {.delays = true}, !is_timed())[JobState::succeeded], 1000);
}

TEST_P(RandomWorlds, StoppedJobsResumeAfterResume) {
  EXPECT_GT(run(200, {.pauses = true}, !is_timed())[JobState::succeeded], 1000);
}

TEST_P(RandomWorlds, StoppedJobsResumeOnLateArms) {
  EXPECT_GT(run(200, {.delays = true, .pauses = true}, !is_timed())[JobState::succeeded], 1000);
}

TEST_P(RandomWorlds, FeasibleJobsSucceedDespiteSingleStops) {
  EXPECT_GT(run(200, {.delays = true, .stops = true}, !is_timed())[JobState::succeeded], 1000);
}

TEST_P(RandomWorlds, EveryJobEndsOnceDespiteCancels) {
  auto ended = run(200, {.delays = true, .stops = true, .cancels = true}, false);
  EXPECT_GT(ended[JobState::canceled], 50);
}

TEST_P(RandomWorlds, EveryJobEndsOnceOnChangingScenes) {
  auto ended = run(200, {.delays = true, .stops = true, .cancels = true, .scenes = true}, false);
  EXPECT_GT(ended[JobState::succeeded], 500);
}

TEST_P(RandomWorlds, FeasibleJobsSucceedDespiteAmendments) {
  auto ended = run(200, {.delays = true, .amends = true, .choices = true}, !is_timed());
  EXPECT_GT(ended[JobState::succeeded], 1000);
}

TEST_P(RandomWorlds, EveryJobEndsOnceDespiteAmendmentsAndCancels) {
  auto ended = run(
      200, {.delays = true, .stops = true, .cancels = true, .parks = true, .amends = true}, false);
  EXPECT_GT(ended[JobState::succeeded], 500);
}

TEST_P(RandomWorlds, EveryJobEndsOnceWithRetreats) {
  auto ended = run(200, {.delays = true, .cancels = true, .parks = true}, false);
  EXPECT_GT(ended[JobState::succeeded], 500);
}

TEST_P(RandomWorlds, JobsWithChoicesSucceed) {
  EXPECT_GT(run(200, {.delays = true, .choices = true}, !is_timed())[JobState::succeeded], 1000);
}

// A job is queued behind a job that waits for another arm. That arm's next job would be blocked
// permanently, which closes a cycle. The cycle ends when another candidate arm takes the job.
TEST(RandomWorld, JobInACycleIsDoneByAnotherArm) {
  World world(2351, "lockstep", {.delays = true, .choices = true});
  world.run();
  ASSERT_GT(world.jobs.size(), 5u);
  for (const JobId job : world.jobs) {
    EXPECT_EQ(world.bench().state(job), JobState::succeeded) << world.bench().job(job).detail();
  }
}

TEST_P(RandomWorlds, EveryJobWithChoicesEndsOnceDespiteCancels) {
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

// When nothing happens anymore, no job waits, even if jobs are impossible.
TEST_P(RandomWorlds, EveryWaitEnds) {
  auto ended = run(220, {.delays = true, .cancels = true, .goals = true, .crowds = true}, false);
  EXPECT_GT(ended[JobState::succeeded], 500);
}

TEST_P(RandomWorlds, EveryWaitEndsWithRetreats) {
  auto ended = run(
      220, {.delays = true, .cancels = true, .parks = true, .goals = true, .crowds = true}, false);
  EXPECT_GT(ended[JobState::succeeded], 500);
}

TEST_P(RandomWorlds, EveryWaitEndsDespiteStopsAndAmendments) {
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
