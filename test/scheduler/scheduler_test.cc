#include "core/scheduler/scheduler.h"

#include <gmock/gmock.h>

#include <numbers>

#include "core/scheduler/deadlines.h"
#include "test/scheduler/bench_cell.h"

namespace armloom {
namespace {

using ::testing::ElementsAre;

TEST(Backlog, IsCheckedAgainWhenTheBlockerEnds) {
  Bench bench(2);
  const JobId first = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  bench.answer_free(at(1ms));
  const JobId second = bench.submit(move({1}, 0, 1, 2s), at(10ms));
  bench.answer_conflict(at(11ms), Conflict::With::motion, first, ArmId{0});
  ASSERT_FALSE(bench.question);
  bench.progressed(first, 1s, at(1s));
  EXPECT_FALSE(bench.question) << "progress alone causes no new check";
  bench.finished(first, at(2s));
  ASSERT_TRUE(bench.question);
  EXPECT_EQ(bench.question->candidates.front().step.job, second);
  EXPECT_EQ(bench.question->rest[0], 1.0) << "the first arm rests at its goal";
  bench.answer_free(at(2001ms));
  EXPECT_EQ(bench.state(second), JobState::scheduled);
  EXPECT_TRUE(bench.job(second).waits_on.empty());
}

TEST(Backlog, IsCheckedAgainWhenTheBlockingArmStartsToMove) {
  Bench bench(2);
  const JobId waits = bench.submit(move({1}, 0, 1, 2s), at(0ms));
  bench.answer_conflict(at(1ms), Conflict::With::rest, {}, ArmId{0});
  EXPECT_EQ(bench.job(waits).waits_on.front().kind, Wait::Kind::arm);
  EXPECT_EQ(bench.job(waits).waits_on.front().arm, ArmId{0});
  bench.submit(move({0}, 0, 1, 2s), at(10ms));
  bench.answer_free(at(11ms));
  ASSERT_TRUE(bench.question);
  EXPECT_EQ(bench.question->candidates.front().step.job, waits);
}

TEST(Backlog, ExpiresAJobExactlyAtItsDeadline) {
  Bench bench(1);
  const JobId job = bench.submit(move({0}, 0, 1, 2s), at(0ms), 100ms);
  bench.answer_conflict(at(2ms), Conflict::With::scene);
  EXPECT_EQ(bench.wake_at, at(102ms));
  bench.step(Wake{}, at(101ms));
  EXPECT_EQ(bench.state(job), JobState::backlogged);
  bench.step(Wake{}, at(102ms));
  EXPECT_EQ(bench.state(job), JobState::expired);
  EXPECT_EQ(bench.job(job).reason(), Reason::backlog_timeout);
  EXPECT_EQ(bench.job(job).detail(), "waited 0.1 s in the backlog");
  EXPECT_EQ(bench.job(job).waits_on.front().kind, Wait::Kind::object) << "what the job waited for";
  EXPECT_EQ(bench.terminal_events[job], 1);
}

TEST(Backlog, TimeoutStartsWhenTheJobIsFirstChecked) {
  Bench bench(1);
  const JobId first = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  bench.answer_free(at(1ms));
  const JobId behind = bench.submit(move({0}, 1, 0, 2s), at(2ms), 100ms);
  EXPECT_EQ(bench.state(behind), JobState::queued);
  EXPECT_EQ(bench.job(behind).waits_on.front().kind, Wait::Kind::predecessor);
  EXPECT_EQ(bench.job(behind).waits_on.front().job, first);
  bench.finished(first, at(2s));
  EXPECT_EQ(bench.state(behind), JobState::queued);
  bench.answer_conflict(at(2001ms), Conflict::With::scene);
  bench.step(Wake{}, at(2100ms));
  EXPECT_EQ(bench.state(behind), JobState::backlogged);
  bench.step(Wake{}, at(2101ms));
  EXPECT_EQ(bench.state(behind), JobState::expired);
}

TEST(Order, OfAnArmQueueIsKept) {  // T11
  Bench bench(1);
  const JobId first = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  const JobId second = bench.submit(move({0}, 1, 0, 2s), at(0ms), 60s, 99);
  EXPECT_EQ(bench.question->candidates.front().step.job, first);
  bench.answer_free(at(1ms));
  EXPECT_FALSE(bench.question) << "the second is not checked while the first runs";
  bench.finished(first, at(2s));
  EXPECT_EQ(bench.question->candidates.front().step.job, second);
}

TEST(Order, JobWithAnotherStartFailsAtItsTurn) {  // T11
  Bench bench(1);
  const JobId first = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  const JobId same_start = bench.submit(move({0}, 0, 0.5, 2s), at(0ms));
  bench.answer_free(at(1ms));
  bench.finished(first, at(2s));
  EXPECT_EQ(bench.state(same_start), JobState::failed);
  EXPECT_EQ(bench.job(same_start).reason(), Reason::start_mismatch);
  EXPECT_EQ(bench.job(same_start).detail(), "a_joint is at 1, but the trajectory begins at 0");
  EXPECT_EQ(bench.terminal_events[same_start], 1);
}

TEST(Order, StartMismatchReportsWholeTurns) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  Bench bench(1);
  const JobId first = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  const JobId turned = bench.submit(move({0}, 1 - 2.0 * kTurn, 0.5, 2s), at(0ms));
  bench.answer_free(at(1ms));
  bench.finished(first, at(2s));
  EXPECT_EQ(bench.job(turned).reason(), Reason::start_mismatch);
  EXPECT_EQ(bench.job(turned).detail(),
            "a_joint is at 1, but the trajectory begins at -11.5664, 2 whole turns away: positions "
            "are not taken modulo 2 pi");
}

TEST(Order, ThousandJobsBehindACanceledJobAllEnd) {
  Bench bench(1);
  const JobId first = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  for (int i = 0; i < 1000; ++i) bench.submit(move({0}, 1, 1.5, 2s), at(0ms));
  bench.step(Cancel{first}, at(0ms));
  EXPECT_TRUE(bench.scheduler.active().empty());
  EXPECT_EQ(bench.terminal_events.size(), 1001u);
}

TEST(Order, FailedTwoArmJobAdvancesBothQueues) {
  Bench bench(2);
  const JobId runs = bench.submit(move({1}, 0, 1, 2s), at(0ms));
  bench.answer_free(at(1ms));
  const JobId both = bench.submit(move({0, 1}, 1, 2, 2s), at(2ms));  // arm 0 is at 0
  const JobId behind = bench.submit(move({0}, 2, 1, 2s), at(3ms));   // also a start mismatch
  bench.finished(runs, at(2s));
  EXPECT_EQ(bench.job(both).reason(), Reason::start_mismatch);
  EXPECT_EQ(bench.job(behind).reason(), Reason::start_mismatch);
  EXPECT_FALSE(bench.question);
}

TEST(Order, PredictsTheFinalRestOfArms) {
  Bench bench(2);
  bench.submit(move({0}, 0, 1, 2s), at(0ms));
  bench.submit(move({0}, 1, 2, 2s), at(0ms));
  EXPECT_EQ(predicted_rest(bench.scheduler.state())[0], 2.0);
  EXPECT_EQ(predicted_rest(bench.scheduler.state())[1], 0.0);
}

TEST(Synchronous, TwoArmJobWaitsForBothQueues) {
  Bench bench(2);
  const JobId a = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  bench.answer_free(at(1ms));
  const JobId both = bench.submit(move({0, 1}, 0, 1, 2s), at(2ms));
  const JobId b = bench.submit(move({1}, 0, 1, 2s), at(3ms));
  EXPECT_FALSE(bench.question);
  EXPECT_EQ(bench.job(both).waits_on.front().job, a);
  EXPECT_EQ(bench.job(b).waits_on.front().job, both);
}

TEST(Overrun, EndsAMotionAtAStandstill) {
  Bench bench(1);
  const JobId job = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  bench.answer_free(at(1ms));
  bench.progressed(job, 0ms, at(3ms));
  bench.progressed(job, 500ms, at(503ms));
  bench.progressed(job, 500ms, at(5s));
  bench.step(Wake{}, at(503ms + kStandstill) - 1ms);
  EXPECT_TRUE(bench.braked.empty());
  ASSERT_TRUE(bench.wake_at);
  EXPECT_EQ(*bench.wake_at, at(503ms + kStandstill));
  bench.step(Wake{}, *bench.wake_at);
  EXPECT_THAT(bench.braked, ElementsAre(job));
  bench.stopped(job, 500ms, at(11s));
  EXPECT_EQ(bench.state(job), JobState::failed);
  EXPECT_EQ(bench.job(job).reason(), Reason::overrun);
}

TEST(Overrun, DoesNotEndASlowMotion) {
  Bench bench(1);
  const JobId job = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  bench.answer_free(at(1ms));
  for (int s = 0; s < 100; s += 9) {
    bench.progressed(job, s * 20ms, at(3ms + s * 1s));
    bench.step(Wake{}, at(4ms + s * 1s));
  }
  EXPECT_TRUE(bench.braked.empty());
  bench.finished(job, at(100s));
  EXPECT_EQ(bench.state(job), JobState::succeeded);
}

TEST(Overrun, EndsALongMotionAtAStandstillOnlyAfterItsDuration) {
  Bench bench(1);
  const JobId job = bench.submit(move({0}, 0, 1, 20s), at(0ms));
  bench.answer_free(at(1ms));
  bench.progressed(job, 0ms, at(3ms));
  bench.progressed(job, 1s, at(1003ms));
  bench.step(Wake{}, at(1ms + 22s + 500ms) - 1ms);
  EXPECT_TRUE(bench.braked.empty());
  bench.step(Wake{}, at(1ms + 22s + 500ms));
  EXPECT_THAT(bench.braked, ElementsAre(job));
}

TEST(Scheduler, ThrowsOnDecreasingTime) {
  Bench bench(1);
  bench.step(Wake{}, at(10ms));
  EXPECT_THROW(bench.step(Wake{}, at(9ms)), std::invalid_argument);
}

TEST(Policies, AreFoundByName) {
  const CellPtr cell = one_joint_arms(1);
  for (const std::string& name : policy_names()) {
    EXPECT_EQ((*make_policy(name, *cell))->name, name);
  }
  const auto unknown = make_policy("clever", *cell);
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().front().detail,
            "unknown policy \"clever\"; known are sequential, lockstep, reservation, "
            "timed_discrete, certified, earliest_start, coordinated");
}

}  // namespace
}  // namespace armloom
