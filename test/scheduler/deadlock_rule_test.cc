#include <gmock/gmock.h>

#include <algorithm>

#include "test/scheduler/ideal_arms.h"

namespace armloom {
namespace {

// Beyond 0.3 rad each arm blocks the other arm near 0.
class Blockage : public ::testing::Test {
 protected:
  static std::vector<Crossing> table() {
    return {{ArmId{0}, 0.3, 9.0, ArmId{1}, -0.1, 0.1}, {ArmId{0}, -0.1, 0.1, ArmId{1}, 0.3, 9.0}};
  }
  static CellPtr cell() {
    auto made = std::make_shared<Cell>(*one_joint_arms(2));
    made->execution.duration_margin = 1h;
    return made;
  }

  Submit blocked() const { return {JobId{0}, move({0}, 0.0, 1.0, 2s), {0, 60s}}; }
  static Submit link(int i) { return {JobId{0}, move({1}, 0.5 * i, 0.5 * (i + 1), 1s), {0, 60s}}; }
  static Submit goal(int i) {
    Submit job = link(i);
    job.goals = {{.arm = ArmId{1}, .to = Eigen::VectorXd::Constant(1, 0.5 * (i + 1))}};
    return job;
  }

  void submit_ten(Submit (*make)(int)) {
    first = bench.submit(blocked());
    for (int i = 0; i < 10; ++i) jobs.push_back(bench.submit(make(i)));
  }
  std::ptrdiff_t failed() const {
    return std::ranges::count_if(jobs,
                                 [&](JobId job) { return bench.job(job).reason().has_value(); });
  }
  void expect_only_the_first_of_each_arm_failed() {
    EXPECT_EQ(bench.job(first).reason(), Reason::deadlock);
    EXPECT_EQ(bench.job(jobs.front()).reason(), Reason::deadlock);
    EXPECT_EQ(failed(), 1) << "no job behind it";
  }
  void expect_the_others_succeed_when_the_arm_has_gone() {
    bench.submit({JobId{0}, move({0}, 0.0, -1.0, 2s), {0, 60s}});
    bench.run();
    for (std::size_t i = 1; i < jobs.size(); ++i) {
      EXPECT_EQ(bench.job(jobs[i]).reason(), Reason::completed) << i << bench.job(jobs[i]).detail();
    }
  }

  IdealArms bench{cell(), std::move(*make_policy("earliest_start", *cell())), Crossings(table()),
                  [](JobId) { return Habits{}; }};
  JobId first{0};
  std::vector<JobId> jobs;
};

TEST_F(Blockage, FailsOnlyTheFirstGoalOfAQueue) {
  submit_ten(goal);
  bench.run_until(at(10s));
  expect_only_the_first_of_each_arm_failed();
  expect_the_others_succeed_when_the_arm_has_gone();
}

TEST_F(Blockage, FailsOnlyTheFirstTrajectoryOfAChain) {
  submit_ten(link);
  bench.run_until(at(10s));
  expect_only_the_first_of_each_arm_failed();
  expect_the_others_succeed_when_the_arm_has_gone();
}

TEST_F(Blockage, FailsOneJobOfEachLongQueueAndTheRestExpires) {
  for (int i = 0; i < 3; ++i) {
    Submit job = goal(i);
    job.trajectory = move({0}, 0.5 * i, 0.5 * (i + 1), 1s);
    job.goals.front().arm = ArmId{0};
    jobs.push_back(bench.submit(std::move(job)));
  }
  for (int i = 0; i < 3; ++i) jobs.push_back(bench.submit(goal(i)));
  bench.run_until(at(10s));
  EXPECT_EQ(failed(), 2);
  EXPECT_FALSE(bench.job(jobs[1]).job->ring.empty());
  EXPECT_FALSE(bench.job(jobs[4]).job->ring.empty());
  bench.run();
  EXPECT_EQ(failed(), 6);
  EXPECT_EQ(std::ranges::count_if(
                jobs, [&](JobId job) { return bench.job(job).reason() == Reason::deadlock; }),
            2);
}

// Job a is paused under `sequential`. b's arm is in a's way, and b cannot get capacity before a.
TEST(DeadlockRule, WaitForCapacityIsPartOfTheCycle) {
  Bench bench(2, "sequential");
  const JobId a = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  bench.answer_free(at(1ms));
  bench.progressed(a, 1ms, at(2ms));
  bench.step(Stop{{ArmId{0}}, "operator"}, at(3ms));
  bench.stopped(a, 2ms, at(10ms));
  const JobId b = bench.submit(move({1}, 0, 1, 2s), at(11ms));
  bench.step(Resume{{ArmId{0}}}, at(1s));
  bench.answer_conflict(at(1001ms), Conflict::With::rest, {}, ArmId{1});
  EXPECT_EQ(bench.job(b).waits_on.front().kind, Wait::Kind::capacity);
  EXPECT_THAT(bench.job(a).job->ring, ::testing::ElementsAre(a, b));
  bench.step(Wake{}, at(1002ms));
  EXPECT_EQ(bench.job(b).reason(), Reason::deadlock);
}

}  // namespace
}  // namespace armloom
