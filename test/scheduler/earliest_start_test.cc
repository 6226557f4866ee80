// Jobs that are given a start ahead: what they hold, what moves their start, what takes it away.
#include <gmock/gmock.h>

#include "test/scheduler/bench_cell.h"

namespace armloom {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// "runs" moves arm a for 2 s from 3 ms on; "ahead" of arm b begins 1 s after the instant that it
// was judged for, at 1013 ms.
struct Ahead : Bench {
  explicit Ahead(std::size_t arms = 3) : Bench(arms, "earliest_start") {
    runs = submit(move({0}, 0, 1, 2s), at(0ms));
    answer_free(at(1ms));
    progressed(runs, 0ms, at(3ms));
    ahead = submit(move({1}, 0, 1, 2s), at(10ms));
    answer_later(at(12ms), runs, 1s);
    dispatched.clear();
  }
  // Feedback of the running job that keeps to its plan.
  void on_plan(TimePoint now) { progressed(runs, now - at(3ms), now); }

  JobId runs{0}, ahead{0};
};
constexpr TimePoint kStart = at(10ms + kAllowanceMin + 1s);

TEST(EarliestStart, SchedulesAJobThatCannotStartNowAndSaysWhatItWaitsFor) {
  Ahead bench;
  EXPECT_EQ(bench.state(bench.ahead), JobState::scheduled);
  EXPECT_EQ(bench.job(bench.ahead).scheduled_at, kStart);
  EXPECT_FALSE(bench.job(bench.ahead).backlogged_at);
  ASSERT_EQ(bench.job(bench.ahead).waits_on.size(), 1u);
  EXPECT_EQ(bench.job(bench.ahead).waits_on.front().kind, Wait::Kind::job);
  EXPECT_EQ(bench.job(bench.ahead).waits_on.front().job, bench.runs);
  EXPECT_THAT(bench.dispatched, IsEmpty());
  EXPECT_FALSE(bench.scheduler.occupant(ArmId{1})) << "its arm knows nothing of it yet";
}

TEST(EarliestStart, CountsInLaterQuestionsAsAMotionThatIsStillToStart) {
  Ahead bench;
  (void)bench.submit(move({2}, 0, 1, 2s), at(100ms));
  ASSERT_EQ(bench.question->others.size(), 2u);
  EXPECT_EQ(bench.question->others.back().job, bench.ahead);
  EXPECT_EQ(bench.question->others.back().progress, at(100ms) + kAllowanceMin - kStart);
  EXPECT_LT(bench.question->others.back().progress, 0ms);
}

TEST(EarliestStart, DispatchesAsFarAheadAsItSaysAndNotBefore) {
  Ahead bench;
  bench.on_plan(at(900ms));
  EXPECT_EQ(bench.wake_at, kStart - kDispatchAhead);
  bench.step(Wake{}, kStart - kDispatchAhead - 1ns);
  EXPECT_THAT(bench.dispatched, IsEmpty());
  bench.step(Wake{}, kStart - kDispatchAhead);
  ASSERT_EQ(bench.dispatched.size(), 1u);
  EXPECT_EQ(bench.dispatched.front().job, bench.ahead);
  EXPECT_EQ(bench.dispatched.front().start_at, kStart);
  EXPECT_EQ(bench.dispatched.front().from_progress, 0ms);
  EXPECT_THAT(bench.job(bench.ahead).waits_on, IsEmpty());
  EXPECT_EQ(bench.scheduler.occupant(ArmId{1}), bench.ahead);
  EXPECT_FALSE(bench.question) << "a dispatch changes no reservation";
}

TEST(EarliestStart, DispatchesAStartThatIsNearAtOnce) {
  Bench bench(2, "earliest_start");
  const JobId runs = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  bench.answer_free(at(1ms));
  const JobId soon = bench.submit(move({1}, 0, 1, 2s), at(10ms));
  bench.answer_later(at(11ms), runs, 10ms);
  EXPECT_EQ(bench.dispatched.back().job, soon);
  EXPECT_EQ(bench.dispatched.back().start_at, at(20ms + kAllowanceMin));
}

TEST(EarliestStart, AJobThatWillNeverBeFreeGoesToTheBacklog) {
  Bench bench(2, "earliest_start");
  const JobId runs = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  bench.answer_free(at(1ms));
  const JobId never = bench.submit(move({1}, 0, 1, 2s), at(10ms));
  bench.answer_conflict(at(11ms), Conflict::With::motion, runs, ArmId{0});
  EXPECT_EQ(bench.state(never), JobState::backlogged);
}

TEST(EarliestStart, ACancelBeforeTheDispatchEndsTheJobAtOnce) {
  Ahead bench;
  bench.step(Cancel{bench.ahead}, at(500ms));
  EXPECT_EQ(bench.state(bench.ahead), JobState::canceled);
  EXPECT_EQ(bench.terminal_events[bench.ahead], 1);
  EXPECT_THAT(bench.braked, IsEmpty());
  // The running one may have counted on its departure.
  ASSERT_TRUE(bench.question);
  EXPECT_EQ(bench.question->candidates.front().job, bench.runs);
  EXPECT_THAT(bench.question->others, IsEmpty());
  bench.answer_free(at(501ms));
  bench.step(Wake{}, kStart);
  EXPECT_THAT(bench.dispatched, IsEmpty());
  bench.finished(bench.runs, at(2003ms));
  EXPECT_TRUE(bench.scheduler.active().empty());
}

TEST(EarliestStart, AStopBeforeTheDispatchPutsItBackAndAResumeJudgesItAgain) {
  Ahead bench;
  bench.step(Stop{{ArmId{1}}, "operator"}, at(500ms));
  EXPECT_THAT(bench.braked, IsEmpty());
  EXPECT_EQ(bench.state(bench.ahead), JobState::queued);
  EXPECT_FALSE(bench.job(bench.ahead).scheduled_at);
  ASSERT_EQ(bench.job(bench.ahead).waits_on.size(), 1u);
  EXPECT_EQ(bench.job(bench.ahead).waits_on.front().kind, Wait::Kind::stop);
  bench.answer_free(at(501ms));  // the running one, beside an arm that stays
  EXPECT_FALSE(bench.question);
  bench.step(Resume{{ArmId{1}}}, at(600ms));
  ASSERT_TRUE(bench.question);
  EXPECT_EQ(bench.question->candidates.front().job, bench.ahead);
  bench.answer_later(at(601ms), bench.runs, 500ms);
  EXPECT_EQ(bench.job(bench.ahead).scheduled_at, at(600ms) + kAllowanceMin + 500ms);
}

TEST(EarliestStart, ASceneThatChangesHasItJudgedAgain) {
  Ahead bench;
  bench.on_plan(at(500ms));
  bench.step(SceneChanged{}, at(500ms));
  ASSERT_EQ(bench.question->candidates.front().job, bench.runs);
  bench.answer_free(at(501ms));
  ASSERT_EQ(bench.question->candidates.front().job, bench.ahead);
  EXPECT_EQ(bench.question->candidates.front().progress, at(501ms) + kAllowanceMin - kStart);
  bench.answer_conflict(at(502ms), Conflict::With::scene);
  EXPECT_THAT(bench.braked, IsEmpty());
  EXPECT_EQ(bench.state(bench.ahead), JobState::queued);
  ASSERT_EQ(bench.question->candidates.front().job, bench.runs) << "it may have counted on it";
  bench.answer_free(at(503ms));
  ASSERT_TRUE(bench.question) << "asked as a start";
  bench.answer_conflict(at(503ms), Conflict::With::scene);
  EXPECT_EQ(bench.state(bench.ahead), JobState::backlogged);
}

TEST(EarliestStart, WhatIsNotJudgedAgainInTimeIsNotDispatched) {
  Ahead bench;
  bench.on_plan(kStart - kDispatchAhead - 2ms);
  bench.step(SceneChanged{}, kStart - kDispatchAhead - 1ms);
  bench.step(Wake{}, kStart - kDispatchAhead);
  EXPECT_THAT(bench.dispatched, IsEmpty());
  EXPECT_EQ(bench.state(bench.ahead), JobState::queued);
  EXPECT_THAT(bench.braked, IsEmpty());
}

TEST(EarliestStart, ALateBlockerTakesTheStartAwayUntilItKeepsUpAgain) {
  Ahead bench;
  bench.progressed(bench.runs, 300ms, at(500ms));  // 197 ms behind
  ASSERT_EQ(bench.question->candidates.front().job, bench.runs);
  bench.answer_free(at(501ms));
  ASSERT_EQ(bench.question->candidates.front().job, bench.ahead);
  EXPECT_TRUE(bench.question->others.front().may_stand);
  bench.answer_conflict(at(502ms), Conflict::With::motion, bench.runs, ArmId{0});
  EXPECT_THAT(bench.braked, IsEmpty());
  EXPECT_EQ(bench.state(bench.ahead), JobState::queued);
  for (int i = 0; i < 3 && bench.question; ++i) {  // the other motion again, then the start
    if (bench.question->candidates.front().job == bench.ahead) break;
    bench.answer_free(at(503ms));
  }
  bench.answer_conflict(at(504ms), Conflict::With::motion, bench.runs, ArmId{0});
  EXPECT_EQ(bench.state(bench.ahead), JobState::backlogged);
  bench.progressed(bench.runs, 500ms, at(500ms + kOnTimeAgain));
  ASSERT_TRUE(bench.question);
  EXPECT_EQ(bench.question->candidates.front().job, bench.ahead);
  EXPECT_FALSE(bench.question->others.front().may_stand);
  bench.answer_later(at(702ms), bench.runs, 900ms);
  EXPECT_EQ(bench.state(bench.ahead), JobState::scheduled);
}

// Answers what is asked until it is asked to move `job` forward.
void until_forward(Bench& bench, JobId job, TimePoint now) {
  for (int i = 0; i < 10 && bench.question; ++i) {
    if (bench.question->candidates.front().job == job && bench.question->find_earliest) return;
    bench.answer_free(now);
  }
  FAIL() << "its start is not reconsidered";
}

TEST(EarliestStart, MovesForwardWhenItsBlockerIsCanceled) {
  Ahead bench;
  bench.on_plan(at(200ms));
  bench.step(Cancel{bench.runs}, at(200ms));
  bench.stopped(bench.runs, 250ms, at(300ms));
  until_forward(bench, bench.ahead, at(301ms));
  EXPECT_EQ(bench.question->candidates.front().progress, 0ms) << "as one that has no start";
  bench.answer_free(at(302ms));
  ASSERT_EQ(bench.dispatched.size(), 1u);
  EXPECT_EQ(bench.dispatched.front().start_at, at(301ms) + kAllowanceMin);
  EXPECT_THAT(bench.job(bench.ahead).waits_on, IsEmpty());
}

TEST(EarliestStart, MovesForwardWhenItsBlockerFaults) {
  Ahead bench;
  bench.step(MotionReport{bench.runs, MotionReport::Kind::faulted, 250ms,
                          Eigen::VectorXd::Constant(1, 0.2), "drive 3"},
             at(253ms));
  until_forward(bench, bench.ahead, at(254ms));
  bench.answer_later(at(255ms), bench.runs, 100ms);
  EXPECT_EQ(bench.job(bench.ahead).scheduled_at, at(254ms) + kAllowanceMin + 100ms);
}

TEST(EarliestStart, MovesForwardWhenItsBlockerEndsBeforeItsTime) {
  Ahead bench;
  bench.on_plan(at(200ms));
  bench.finished(bench.runs, at(400ms));
  until_forward(bench, bench.ahead, at(401ms));
  bench.answer_free(at(402ms));
  EXPECT_EQ(bench.dispatched.back().start_at, at(400ms) + kAllowanceMin);
}

TEST(EarliestStart, MovesForwardWhenItsBlockerIsHeldOutOfTheWay) {
  Ahead bench;
  bench.on_plan(at(200ms));
  bench.step(Stop{{ArmId{0}}, "operator"}, at(200ms));
  bench.stopped(bench.runs, 250ms, at(300ms));
  until_forward(bench, bench.ahead, at(301ms));
  bench.answer_free(at(302ms));
  EXPECT_EQ(bench.dispatched.back().job, bench.ahead);
}

// b begins after a has passed, c after b; c was submitted before b.
TEST(EarliestStart, MovesForwardBehindAnotherThatMovesForward) {
  Bench bench(4, "earliest_start");
  const JobId a = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  bench.answer_free(at(1ms));
  const JobId stands = bench.submit(move({3}, 0, 1, 2s), at(2ms));
  const JobId c = bench.submit(move({2}, 0, 1, 2s), at(3ms), 60s, -1);
  const JobId b = bench.submit(move({1}, 0, 1, 2s), at(4ms));
  bench.answer_free(at(4ms));
  ASSERT_EQ(bench.question->candidates.front().job, b);
  bench.answer_later(at(5ms), a, 1s);
  ASSERT_EQ(bench.question->candidates.front().job, c);
  bench.answer_later(at(6ms), b, 2s);
  for (const JobId job : {a, stands}) bench.progressed(job, 40ms, at(50ms));
  bench.finished(a, at(210ms));
  ASSERT_EQ(bench.question->candidates.front().job, c);
  bench.answer_later(at(211ms), b, 1795ms);  // still behind b: no gain
  ASSERT_EQ(bench.question->candidates.front().job, b);
  bench.answer_free(at(212ms));
  ASSERT_TRUE(bench.question) << "b is gone earlier now";
  EXPECT_EQ(bench.question->candidates.front().job, c);
  bench.answer_later(at(213ms), b, 1s);
  EXPECT_EQ(bench.job(c).scheduled_at, at(212ms) + kAllowanceMin + 1s);
  EXPECT_FALSE(bench.question) << "and then all is as early as it can be";
}

TEST(EarliestStart, AForwardQuestionNeverPutsAStartOff) {
  for (const Duration shift :
       {Duration(2s), Duration(615ms), Duration(570ms)}) {  // 0.6 s on it starts anyway
    Ahead bench;
    bench.on_plan(at(200ms));
    bench.finished(bench.runs, at(400ms));
    until_forward(bench, bench.ahead, at(401ms));
    bench.answer_later(at(402ms), bench.runs, shift);
    EXPECT_EQ(bench.state(bench.ahead), JobState::scheduled);
    EXPECT_EQ(bench.job(bench.ahead).scheduled_at, kStart) << to_seconds(shift);
    EXPECT_FALSE(bench.question) << "asked once";
    bench.step(Wake{}, kStart - kDispatchAhead);
    EXPECT_EQ(bench.dispatched.back().start_at, kStart);
  }
}

TEST(EarliestStart, AForwardQuestionWithoutAnAnswerLeavesTheStart) {
  Ahead bench;
  bench.on_plan(at(200ms));
  bench.finished(bench.runs, at(400ms));
  until_forward(bench, bench.ahead, at(401ms));
  bench.answer_conflict(at(402ms), Conflict::With::rest, {}, ArmId{0});
  EXPECT_EQ(bench.job(bench.ahead).scheduled_at, kStart);
  EXPECT_EQ(bench.state(bench.ahead), JobState::scheduled);
}

TEST(EarliestStart, AnAnswerThatComesAfterTheDispatchMovesNothing) {
  Ahead bench;
  bench.on_plan(at(900ms));
  bench.finished(bench.runs, at(930ms));
  until_forward(bench, bench.ahead, at(931ms));
  bench.step(Wake{}, kStart - kDispatchAhead);
  ASSERT_EQ(bench.dispatched.size(), 1u);
  bench.answer_free(kStart - kDispatchAhead + 1ms);
  EXPECT_EQ(bench.dispatched.size(), 1u) << "dispatched once";
  EXPECT_EQ(bench.job(bench.ahead).scheduled_at, kStart);
}

TEST(EarliestStart, AsksForALaterInstantWhenTheOneFoundHasPassed) {
  Bench bench(2, "earliest_start");
  const JobId runs = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  bench.answer_free(at(1ms));
  const JobId job = bench.submit(move({1}, 0, 1, 2s), at(10ms));
  bench.answer_later(at(70ms), runs, 20ms);  // 60 ms for an answer
  EXPECT_EQ(bench.state(job), JobState::queued);
  ASSERT_TRUE(bench.question);
  EXPECT_GE(bench.question->start_at, at(70ms + 60ms)) << "an answer as slow comes in time";
}

TEST(EarliestStart, KeepsTheOrderOfAnArm) {
  Ahead bench;
  const JobId behind = bench.submit(move({1}, 1, 0, 1s), at(20ms), 60s, 99);
  EXPECT_FALSE(bench.question);
  ASSERT_EQ(bench.job(behind).waits_on.size(), 1u);
  EXPECT_EQ(bench.job(behind).waits_on.front().kind, Wait::Kind::order);
  EXPECT_EQ(bench.job(behind).waits_on.front().job, bench.ahead);
  bench.on_plan(at(900ms));
  bench.step(Wake{}, kStart - kDispatchAhead);
  bench.progressed(bench.ahead, 0ms, kStart);
  EXPECT_FALSE(bench.question);
  bench.finished(bench.runs, at(2003ms));
  bench.finished(bench.ahead, kStart + 2s);
  ASSERT_TRUE(bench.question);
  EXPECT_EQ(bench.question->candidates.front().job, behind);
}

TEST(EarliestStart, WhatStandsBehindACanceledStartFailsWhereItCannotBegin) {
  Ahead bench;
  const JobId behind = bench.submit(move({1}, 1, 0, 1s), at(20ms));
  bench.step(Cancel{bench.ahead}, at(30ms));
  EXPECT_EQ(bench.job(behind).reason, Reason::start_mismatch);
  EXPECT_EQ(bench.terminal_events[behind], 1);
}

TEST(EarliestStart, AnInterruptEndsEveryJobOnce) {
  Ahead bench;
  const JobId behind = bench.submit(move({1}, 1, 0, 1s), at(20ms));
  bench.step(Interrupt{}, at(30ms));
  for (const JobId job : {bench.runs, bench.ahead, behind}) {
    EXPECT_EQ(bench.state(job), JobState::interrupted);
    EXPECT_EQ(bench.terminal_events[job], 1);
  }
  bench.step(Wake{}, kStart);
  EXPECT_THAT(bench.dispatched, IsEmpty());
}

TEST(EarliestStart, SeveralHeldJobsAreNotScheduledAheadAsOne) {
  Bench bench(2, "earliest_start");
  const JobId first = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  const JobId second = bench.submit(move({1}, 0, 1, 2s), at(0ms));
  bench.answer_free(at(1ms));
  bench.answer_free(at(2ms));
  for (const JobId job : {first, second}) bench.progressed(job, 0ms, at(5ms));
  bench.step(Stop{{ArmId{0}, ArmId{1}}, "operator"}, at(6ms));
  for (const JobId job : {first, second}) bench.stopped(job, 0ms, at(10ms));
  bench.step(Resume{{ArmId{0}, ArmId{1}}}, at(1s));
  ASSERT_EQ(bench.question->candidates.size(), 2u);
  EXPECT_FALSE(bench.question->find_earliest);
}

// It has started once, so that its arm still holds its motion.
TEST(EarliestStart, AHeldJobThatIsCanceledBeforeItsNewStartIsReleased) {
  Bench bench(2, "earliest_start");
  const JobId held = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  const JobId other = bench.submit(move({1}, 0, 1, 2s), at(0ms));
  bench.answer_free(at(1ms));
  bench.answer_free(at(2ms));
  for (const JobId job : {held, other}) bench.progressed(job, 0ms, at(5ms));
  bench.step(Stop{{ArmId{0}}, "operator"}, at(6ms));
  bench.stopped(held, 0ms, at(10ms));
  bench.step(Resume{{ArmId{0}}}, at(12ms));
  until_forward(bench, held, at(13ms));
  bench.answer_later(at(14ms), other, 1s);
  ASSERT_EQ(bench.state(held), JobState::scheduled);
  bench.step(Stop{{ArmId{0}}, "operator"}, at(100ms));
  EXPECT_EQ(bench.state(held), JobState::holding) << "as it was before";
  bench.step(Resume{{ArmId{0}}}, at(200ms));
  until_forward(bench, held, at(201ms));
  bench.answer_later(at(202ms), other, 1s);
  bench.step(Cancel{held}, at(300ms));
  EXPECT_EQ(bench.state(held), JobState::canceled);
  EXPECT_THAT(bench.released, ElementsAre(held));
}

}  // namespace
}  // namespace armloom
