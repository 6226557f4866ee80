// Faults that random worlds found, as minimal cases.
#include <gmock/gmock.h>

#include <algorithm>
#include <utility>

#include "core/policies/policy.h"
#include "test/scheduler/ideal_arms.h"

namespace armloom {
namespace {

// x ends in b's way. y, the next job of the same arm, moves the arm away. y is admitted together
// with b.
TEST(Admission, JobAdmittedBehindAnotherReportsThatItWaits) {
  Bench bench(2, "coordinated");
  const JobId x = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  bench.answer_free(at(1ms));
  const JobId y = bench.submit(move({0}, 1, 0, 2s), at(2ms));
  const JobId b = bench.submit(move({1}, 0, 1, 2s), at(2ms));
  bench.progressed(x, 1900ms, at(3ms));
  const PairRegions at_goal{
      only_step(b), only_step(x), {region(ProgressBox{1s, 1200ms, 1900ms, 2s})}};
  bench.answer_regions(at(4ms), {at_goal});
  ASSERT_EQ(bench.question->candidates.size(), 2u);
  bench.answer_regions(
      at(5ms),
      {at_goal, {only_step(b), only_step(y), {region(ProgressBox{1s, 1200ms, 0s, 200ms})}}});
  ASSERT_EQ(bench.state(y), JobState::scheduled);
  ASSERT_EQ(bench.job(y).waits_on.size(), 1u);
  EXPECT_EQ(bench.job(y).waits_on.front().kind, Wait::Kind::predecessor);
  EXPECT_EQ(bench.job(y).waits_on.front().job, x);
}

// The first motion's last report before its end is from before the region.
TEST(Authority, GrowsWhenTheFirstMotionEnds) {
  OneBehindAnother two(ProgressBox{1500ms, 1600ms, 1700ms, 1800ms});
  Bench& bench = two.bench;
  const JobId first = two.first, second = two.second;
  bench.progressed(second, 500ms, at(1s));
  bench.progressed(second, 1s, at(2s));
  bench.progressed(second, 1500ms, at(3s));
  ASSERT_LE(bench.authority(second), 1500ms);
  bench.finished(first, at(4s));
  EXPECT_GT(bench.authority(second), 1500ms) << "its way is free";
}

// The second motion rests and has reported that already.
TEST(Authority, GrowsInTheStepInWhichTheFirstMotionLeaves) {
  OneBehindAnother two(ProgressBox{1500ms, 1600ms, 1300ms, 1400ms});
  Bench& bench = two.bench;
  const JobId first = two.first, second = two.second;
  bench.progressed(second, 500ms, at(1s));
  bench.progressed(second, 1s, at(1500ms));
  bench.progressed(second, 1400ms, at(1599ms));
  ASSERT_LE(bench.authority(second), 1500ms);
  bench.progressed(first, 1399ms, at(1600ms));
  ASSERT_LE(bench.authority(second), 1500ms);
  bench.progressed(first, 1400ms, at(1601ms));
  EXPECT_GT(bench.authority(second), 1500ms);
}

TEST(Stop, PausesAJobThatHasNotReportedProgress) {
  Bench bench(1);
  const JobId job = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  bench.answer_free(at(1ms));
  bench.step(Stop{{ArmId{0}}, "operator"}, at(300ms));
  bench.stopped(job, 400ms, at(500ms));
  EXPECT_EQ(bench.state(job), JobState::paused);
  bench.step(Resume{{ArmId{0}}}, at(1s));
  EXPECT_EQ(bench.state(job), JobState::paused) << bench.job(job).detail();
  bench.answer_free(at(1001ms));
  EXPECT_EQ(bench.dispatched.back().from_progress, 400ms);
}

// `blocked`, which waits for an arm without jobs, is a candidate too. Only x can run.
TEST(Admission, FreeJobIsNotDeferredForABlockedJob) {
  Bench bench(3, "coordinated");
  const JobId blocked = bench.submit(move({1}, 0, 1, 2s), at(0ms));
  bench.answer_regions(at(1ms),
                       {{only_step(blocked), ArmId{2}, {region(ProgressBox{1s, 2s, 0s, 0s})}}});
  const JobId x = bench.submit(move({0}, 0, 1, 2s), at(2ms));
  while (bench.question && bench.question->candidates.size() == 1) bench.answer_free(at(3ms));
  ASSERT_TRUE(bench.question) << "both are candidates of one question";
  ASSERT_EQ(bench.question->candidates.front().step.job, x);
  bench.answer_conflict(at(4ms), Conflict::With::scene);
  ASSERT_TRUE(bench.question) << "x alone";
  bench.answer_free(at(5ms));
  EXPECT_EQ(bench.state(x), JobState::scheduled);
}

// `waits` may pass after `leaves` has left its start; `leaves` is stopped before it moves.
TEST(Resume, OfAnUnstartedJobUnblocksJobsThatWaitForItsStart) {
  for (const char* policy : {"lockstep", "certified", "earliest_start"}) {
    Bench bench(2, policy);
    const JobId leaves = bench.submit(move({0}, 0, 1, 2s), at(0ms));
    const JobId waits = bench.submit(move({1}, 0, 1, 4s), at(0ms));
    bench.answer_free(at(1ms));
    const ConflictRegion at_start = region(ProgressBox{0s, 1s, 2s, 3s});
    const PairRegions of_waits{
        only_step(waits), only_step(leaves), {region(ProgressBox{2s, 3s, 0s, 1s})}};
    bench.answer_regions(at(2ms), {of_waits});
    ASSERT_EQ(bench.state(waits), JobState::scheduled) << policy;
    bench.progressed(waits, 900ms, at(1s));
    bench.step(Stop{{ArmId{0}, ArmId{1}}, "operator"}, at(1500ms));
    bench.stopped(leaves, 0ms, at(1501ms));
    bench.stopped(waits, 1500ms, at(1600ms));
    bench.step(Resume{{ArmId{0}, ArmId{1}}}, at(3s));
    for (int i = 0; i < 4 && bench.question; ++i) {
      const bool of_it = bench.question->candidates.front().step.job == leaves;
      bench.answer_regions(
          at(3001ms),
          of_it ? std::vector<PairRegions>{{only_step(leaves), only_step(waits), {at_start}}}
                : std::vector<PairRegions>{});
    }
    EXPECT_EQ(bench.state(leaves), JobState::scheduled) << policy;
    EXPECT_EQ(bench.authority(waits) > 2s, false) << policy;
    const auto again = [leaves](const Dispatch& d) { return d.step.job == leaves; };
    EXPECT_EQ(std::ranges::count_if(bench.dispatched, again), 2) << policy;
  }
}

TEST(Lockstep, NextJobOfABlockingArmJoinsTheRound) {
  Bench bench(2, "lockstep");
  const JobId canceled = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  const JobId pauses = bench.submit(move({1}, 0, 1, 2s), at(0ms));
  bench.answer_free(at(1ms));
  bench.progressed(canceled, 500ms, at(501ms));
  bench.answer_regions(
      at(502ms),
      {{only_step(pauses), only_step(canceled), {region(ProgressBox{1500ms, 1600ms, 500ms, 1s})}}});
  ASSERT_EQ(bench.state(pauses), JobState::scheduled);
  bench.step(Cancel{canceled}, at(503ms));
  bench.stopped(canceled, 600ms, at(603ms));
  bench.progressed(pauses, 700ms, at(1s));
  bench.progressed(pauses, 1500ms, at(2s));
  bench.progressed(pauses, 1500ms, at(3s));
  ASSERT_TRUE(bench.job(pauses).pausing());
  const JobId next = bench.submit(move({0}, bench.scheduler.state().arms.rest()[0], 0, 2s), at(4s));
  ASSERT_TRUE(bench.question) << "it would wait for the round, and the round for it";
  EXPECT_EQ(bench.question->candidates.front().step.job, next);
}

// The job behind the canceled one ends when the canceled motion comes to rest.
TEST(Cancel, OfABlockingArmsLastJobStartsTheTimeoutOfWaitingJobs) {
  OneBehindAnother two(ProgressBox{1500ms, 1800ms, 0ms, 1200ms});
  Bench& bench = two.bench;
  bench.submit(move({0}, 1, 0, 2s), at(504ms));
  bench.progressed(two.second, 900ms, at(2s));
  bench.progressed(two.second, 1500ms - kShortOf, at(3s));
  bench.step(Stop{{ArmId{1}}, "operator"}, at(3100ms));
  bench.stopped(two.second, 1500ms - kShortOf, at(3200ms));
  bench.step(Resume{{ArmId{1}}}, at(4s));
  bench.answer_free(at(4s));
  ASSERT_TRUE(bench.job(two.second).pausing());
  bench.step(Cancel{two.first}, at(5s));
  bench.wake_at.reset();
  bench.stopped(two.first, 1100ms, at(6s));
  ASSERT_EQ(bench.scheduler.active(), std::vector{two.second});
  ASSERT_TRUE(bench.wake_at) << "nobody looks at it any more";
  bench.step(Wake{}, *bench.wake_at);
  EXPECT_EQ(bench.job(two.second).reason(), Reason::backlog_timeout);
}

// The team's motion is canceled in b's way. Then one of the team's arms leaves.
TEST(Blockades, TeamBlocksUntilAllOfItsArmsHaveLeft) {
  const StepId both{JobId{1}}, b{JobId{2}}, next{JobId{3}};
  PrecedenceGraph graph(3);
  const auto admit = [&](const CoordinatedMotion& motion, const std::vector<PairRegions>& regions) {
    const std::vector<CoordinatedMotion> candidates{motion};
    const PassingOrders orders = cheapest_orders(graph.question(candidates, regions));
    ASSERT_TRUE(orders.blockers.empty());
    graph.admit(candidates, orders);
  };
  admit({.step = both, .arms = {ArmId{0}, ArmId{1}}, .duration = 5s}, {});
  graph.granted(both, 5s);
  admit({.step = b, .arms = {ArmId{2}}, .duration = 5s},
        {{b, both, {region(ProgressBox{2s, 3s, 2s, 3s})}}});
  graph.progress(both, 2500ms);
  graph.abandon(both, 2500ms);
  EXPECT_LE(graph.limit(b), 2s);
  admit({.step = next, .arms = {ArmId{0}}, .duration = 5s}, {});
  EXPECT_LE(graph.limit(b), 2s) << "arm 1 has not moved";
}

// `in` ends in b's path, and `half` ends in a's path, so at first only `in` is in a sequence. Then
// `on` moves b out of a's path. Now b goes first, although `half` waits for `in`.
class InTurn : public ::testing::TestWithParam<std::string> {};

TEST_P(InTurn, WaitingJobIsCheckedAgainWhenTheSequenceChanges) {
  constexpr ArmId a{0}, b{1};
  const Crossings table(
      {{a, 0.4, 0.6, b, 0.45, 0.55}, {a, 0.95, 1.05, b, 0.2, 0.3}, {a, 0.95, 1.05, b, 0.7, 0.8}});
  const auto cell = std::make_shared<Cell>(*one_joint_arms(2));
  cell->scheduling.aging = 3s;  // `half` is asked about first
  IdealArms arms(cell, std::move(*make_policy(GetParam(), *cell)), table,
                 [](JobId) { return Habits{}; });
  const JobId out = arms.submit({JobId{0}, visit(0, 0, -0.5, 2s), {.backlog_timeout = 100s}});
  const JobId away = arms.submit({JobId{0}, visit(0, 0, -0.5, 10s), {.backlog_timeout = 100s}});
  const JobId in = arms.submit({JobId{0}, move({0}, 0, 1, 2s), {.backlog_timeout = 100s}});
  const JobId half = arms.submit({JobId{0}, move({1}, 0, 0.5, 2s), {.backlog_timeout = 100s}});
  arms.run_until(at(5s));
  const JobId on = arms.submit({JobId{0}, move({1}, 0.5, 1, 2s), {.backlog_timeout = 100s}});
  arms.run();
  for (const JobId job : {out, away, in, half, on}) {
    EXPECT_EQ(arms.state(job), JobState::succeeded) << "job " << job.value();
  }
}

// Arm a could do `either` sooner, behind `before`. But `stays` blocks that path permanently, and b
// moves to a place where `either` cannot start.
TEST_P(InTurn, RemainingArmTakesAJobThatAnotherCannotDo) {
  constexpr ArmId a{0}, c{2};
  IdealArms arms(one_joint_arms(3), std::move(*make_policy(GetParam(), *one_joint_arms(3))),
                 Crossings({{a, 0.4, 0.6, c, 0.9, 1.1}}), [](JobId) { return Habits{}; });
  const JobId before = arms.submit({JobId{0}, visit(0, 0, -0.5, 2s), {.backlog_timeout = 100s}});
  Submit by_either{JobId{0}, visit(0, 0, 0.8, 4s), {.backlog_timeout = 100s}};
  by_either.alternatives = {by_either.trajectory, visit(1, 0, 0.9, 7s)};
  const JobId either = arms.submit(by_either);
  const JobId stays =
      arms.submit({JobId{0}, move({2}, 0, 1, 1s), {.priority = 5, .backlog_timeout = 100s}});
  const JobId leaves = arms.submit({JobId{0}, move({1}, 0, 0.3, 1s), {.backlog_timeout = 100s}});
  arms.run();
  for (const JobId job : {before, either, stays, leaves}) {
    EXPECT_EQ(arms.state(job), JobState::succeeded) << "job " << job.value();
  }
}
INSTANTIATE_TEST_SUITE_P(Policies, InTurn,
                         ::testing::Values("sequential", "lockstep", "reservation", "certified",
                                           "earliest_start"),
                         [](const auto& policy) { return policy.param; });

class ReopenedTurn : public ::testing::TestWithParam<std::string> {};

// `halfway` ends in the path of `passes`, so it waits for that job, whose arm is stopped. With
// `back`, its arm does not stay there.
TEST_P(ReopenedTurn, WaitingJobIsCheckedAgainWhenItsArmGetsAJobThatMovesItAway) {
  constexpr ArmId a{0}, b{1};
  IdealArms arms(one_joint_arms(2), std::move(*make_policy(GetParam(), *one_joint_arms(2))),
                 Crossings({{a, 0.4, 0.6, b, 0.45, 0.55}}), [](JobId) { return Habits{}; });
  arms.input(Stop{{a}, "operator"});
  const JobId passes = arms.submit({JobId{0}, move({0}, 0, 1, 2s), {.backlog_timeout = 100s}});
  const JobId halfway = arms.submit({JobId{0}, move({1}, 0, 0.5, 2s), {.backlog_timeout = 100s}});
  arms.run_until(at(5s));
  EXPECT_EQ(arms.state(halfway), JobState::queued);
  const JobId back = arms.submit({JobId{0}, move({1}, 0.5, 0, 2s), {.backlog_timeout = 100s}});
  arms.run_until(at(15s));
  EXPECT_EQ(arms.state(halfway), JobState::succeeded);
  EXPECT_EQ(arms.state(back), JobState::succeeded);
  arms.input(Resume{{a}});
  arms.run();
  EXPECT_EQ(arms.state(passes), JobState::succeeded);
}

INSTANTIATE_TEST_SUITE_P(Policies, ReopenedTurn, ::testing::ValuesIn(policy_names()),
                         [](const auto& policy) { return policy.param; });

}  // namespace
}  // namespace armloom
