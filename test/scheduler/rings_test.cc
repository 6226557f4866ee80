#include <gmock/gmock.h>

#include "core/scheduler/trial.h"
#include "test/scheduler/bench_cell.h"

namespace armloom {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// Each of two arms rests where the other arm's job must go.
struct Swap : Bench {
  Swap() : Bench(3, "certified") {
    a = submit(move({0}, 0, 1, 2s), at(0ms));
    b = submit(move({1}, 0, 1, 2s), at(0ms));
    answer_conflict(at(1ms), Conflict::With::rest, {}, ArmId{1});
    answer_conflict(at(2ms), Conflict::With::rest, {}, ArmId{0});
  }
  JobId a{0}, b{0};
};

TEST(Deadlock, IsReportedBeforeAJobFails) {
  Swap bench;
  EXPECT_THAT(bench.job(bench.a).job->ring, ElementsAre(bench.a, bench.b));
  EXPECT_THAT(bench.job(bench.b).job->ring, ElementsAre(bench.b, bench.a));
  EXPECT_EQ(bench.state(bench.a), JobState::backlogged);
  EXPECT_EQ(bench.state(bench.b), JobState::backlogged);
  ASSERT_TRUE(bench.wake_at);
  EXPECT_LE(*bench.wake_at, at(3ms));
}

TEST(Deadlock, FailsTheLastJobAndTheOtherWaitsForItsArm) {
  Swap bench;
  bench.step(Wake{}, at(3ms));
  EXPECT_EQ(bench.state(bench.b), JobState::failed);
  EXPECT_EQ(bench.job(bench.b).reason(), Reason::deadlock);
  EXPECT_THAT(bench.job(bench.b).job->ring, ElementsAre(bench.b, bench.a)) << "kept as the reason";
  EXPECT_EQ(bench.terminal_events[bench.b], 1);
  EXPECT_EQ(bench.state(bench.a), JobState::backlogged);
  EXPECT_THAT(bench.job(bench.a).job->ring, IsEmpty());
  ASSERT_TRUE(bench.question);
  bench.answer_conflict(at(4ms), Conflict::With::rest, {}, ArmId{1});
  EXPECT_EQ(bench.job(bench.a).waits_on.front().kind, Wait::Kind::arm);
  EXPECT_THAT(bench.job(bench.a).job->ring, IsEmpty()) << "an idle arm closes no cycle";
  bench.step(Wake{}, at(1s));
  EXPECT_EQ(bench.state(bench.a), JobState::backlogged);
}

// In the trial the new job waits for b. The trial must not resolve the cycle.
TEST(Deadlock, IsNotResolvedWithinATrial) {
  Bench bench(3, "certified");
  const JobId a = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  const JobId b = bench.submit(move({1}, 0, 1, 2s), at(0ms));
  bench.answer_conflict(at(1ms), Conflict::With::rest, {}, ArmId{1});
  const Submit behind{.job = bench.next_id(), .trajectory = move({1}, 1, 0, 2s)};
  Trial trial(bench.scheduler, {bench.question}, {behind}, behind.job, at(1ms));
  for (int n = 0; trial.next(); ++n) {
    ASSERT_LT(n, 5);
    const Question question = *trial.next();
    const JobId asked = question.candidates.front().step.job;
    const Proximity close{.body_a = "own", .body_b = "other", .arm_b = ArmId{asked == a ? 1u : 0u}};
    trial.answer(
        {.kind = Verdict::Kind::conflict,
         .version = question.version,
         .conflicts = {Conflict{Conflict::With::rest, only_step(asked), {}, close, 100ms, 200ms}}});
  }
  const auto waits = trial.outcome().waits;
  ASSERT_EQ(waits.size(), 1u);
  EXPECT_EQ(waits.front().job, b);
}

// Stopped so that neither can continue.
TEST(Deadlock, IncludesJobsPausedOnTheirPaths) {
  Bench bench(2, "certified");
  const JobId a = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  const JobId b = bench.submit(move({1}, 0, 1, 2s), at(0ms));
  bench.answer_free(at(1ms));
  bench.answer_free(at(2ms));
  for (JobId job : {a, b}) bench.progressed(job, 1ms, at(5ms));
  bench.step(Stop{{ArmId{0}, ArmId{1}}, "operator"}, at(6ms));
  for (JobId job : {a, b}) bench.stopped(job, 2ms, at(10ms));
  bench.step(Resume{{ArmId{0}, ArmId{1}}}, at(1s));
  ASSERT_EQ(bench.question->candidates.size(), 1U);
  bench.answer_conflict(at(1002ms), Conflict::With::rest, {}, ArmId{1});
  EXPECT_THAT(bench.job(a).job->ring, IsEmpty()) << "the other job may be able to continue";
  bench.answer_conflict(at(1003ms), Conflict::With::rest, {}, ArmId{0});
  EXPECT_THAT(bench.job(a).job->ring, ElementsAre(a, b));
  bench.step(Wake{}, at(1004ms));
  EXPECT_EQ(bench.job(b).reason(), Reason::deadlock);
  bench.answer_free(at(1005ms));
  EXPECT_EQ(bench.state(a), JobState::scheduled);
}

TEST(Deadlock, CanceledJobBreaksTheCycle) {
  Swap bench;
  bench.step(Cancel{bench.a}, at(3ms));
  EXPECT_THAT(bench.job(bench.a).job->ring, IsEmpty());
  EXPECT_EQ(bench.state(bench.b), JobState::backlogged);
  EXPECT_THAT(bench.job(bench.b).job->ring, IsEmpty());
  EXPECT_FALSE(bench.job(bench.b).reason());
}

TEST(Deadlock, IsCheckedAgainOnASceneChangeBeforeAJobFails) {
  Swap bench;
  bench.step(SceneChanged{{ArmId{0}, ArmId{1}}}, at(3ms));
  EXPECT_THAT(bench.job(bench.b).job->ring, IsEmpty());
  bench.answer_free(at(4ms));
  EXPECT_EQ(bench.state(bench.a), JobState::scheduled);
  EXPECT_EQ(bench.state(bench.b), JobState::backlogged);
}

TEST(Deadlock, IncludesThreeJobsWhileOthersMove) {
  Bench bench(4, "certified");
  const JobId moves = bench.submit(move({3}, 0, 1, 20s), at(0ms));
  bench.answer_free(at(1ms));
  const JobId a = bench.submit(move({0}, 0, 1, 2s), at(2ms));
  bench.answer_conflict(at(3ms), Conflict::With::rest, {}, ArmId{1});
  const JobId b = bench.submit(move({1}, 0, 1, 2s), at(4ms));
  bench.answer_conflict(at(5ms), Conflict::With::rest, {}, ArmId{2});
  EXPECT_THAT(bench.job(b).job->ring, IsEmpty());
  const JobId c = bench.submit(move({2}, 0, 1, 2s), at(6ms));
  bench.answer_conflict(at(7ms), Conflict::With::rest, {}, ArmId{0});
  EXPECT_THAT(bench.job(a).job->ring, ElementsAre(a, b, c));
  EXPECT_THAT(bench.job(b).job->ring, ElementsAre(b, c, a));
  EXPECT_THAT(bench.job(c).job->ring, ElementsAre(c, a, b));
  bench.progressed(moves, 0ms, at(8ms));
  bench.step(Wake{}, at(9ms));
  EXPECT_EQ(bench.state(c), JobState::failed);
  EXPECT_EQ(bench.state(moves), JobState::running);
}

TEST(Deadlock, MayIncludeAPredecessor) {
  // a waits until arm b moves away, but arm b's only job comes after a.
  Bench bench(2, "certified");
  const JobId a = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  bench.answer_conflict(at(1ms), Conflict::With::rest, {}, ArmId{1});
  bench.step(
      Submit{.job = JobId{2}, .trajectory = move({1}, 0, 1, 2s), .terms = {0, 60s}, .after = {a}},
      at(2ms));
  EXPECT_THAT(bench.job(a).job->ring, ElementsAre(a, JobId{2}));
  bench.step(Wake{}, at(3ms));
  EXPECT_EQ(bench.job(JobId{2}).reason(), Reason::deadlock);
  EXPECT_EQ(bench.state(a), JobState::backlogged);
}

TEST(Deadlock, DoesNotIncludeJobsThatWaitForAMotion) {
  Bench bench(3, "certified");
  const JobId runs = bench.submit(move({2}, 0, 1, 2s), at(0ms));
  bench.answer_free(at(1ms));
  const JobId a = bench.submit(move({0}, 0, 1, 2s), at(2ms));
  bench.answer_conflict(at(3ms), Conflict::With::rest, {}, ArmId{1});
  const JobId b = bench.submit(move({1}, 0, 1, 2s), at(4ms));
  bench.answer_conflict(at(5ms), Conflict::With::motion, runs, ArmId{2});
  EXPECT_THAT(bench.job(a).job->ring, IsEmpty());
  EXPECT_THAT(bench.job(b).job->ring, IsEmpty());
}

TEST(Deadlock, DoesNotIncludeAStoppedArm) {
  Bench bench(2, "certified");
  bench.step(Stop{{ArmId{1}}, "operator"}, at(0ms));
  const JobId a = bench.submit(move({0}, 0, 1, 2s), at(1ms));
  const JobId b = bench.submit(move({1}, 0, 1, 2s), at(1ms));
  bench.answer_conflict(at(2ms), Conflict::With::rest, {}, ArmId{1});
  EXPECT_FALSE(bench.question);
  EXPECT_THAT(bench.job(a).job->ring, IsEmpty());
  EXPECT_EQ(bench.job(b).waits_on.front().kind, Wait::Kind::stop);
}

}  // namespace
}  // namespace armloom
