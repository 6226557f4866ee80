#include <gmock/gmock.h>

#include "test/scheduler/bench_cell.h"

namespace armloom {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// Each of two arms rests where the other arm's job must go. Because on_idle_blocker is `park`, the
// scheduler asks at once about a retreat of b's arm.
struct Parking : Bench {
  explicit Parking(const char* policy = "certified") : Bench(one_joint_arms_that_park(3), policy) {
    a = submit(move({0}, 0, 1, 2s), at(0ms));
    b = submit(move({1}, 0, 1, 2s), at(0ms));
    answer_conflict(at(1ms), Conflict::With::rest, {}, ArmId{1});
    answer_conflict(at(2ms), Conflict::With::rest, {}, ArmId{0});
  }
  void answer_way_and_passing() {
    answer_free(at(3ms));
    answer_free(at(4ms));
    ASSERT_EQ(asides.size(), 2u);
    way = asides[0].job;
    back = asides[1].job;
  }
  void go_aside() {
    answer_way_and_passing();
    ASSERT_EQ(question->candidates.front().step.job, way);
    answer_free(at(5ms));
    progressed(way, 0ms, at(10ms));
    if (question) answer_conflict(at(11ms), Conflict::With::motion, way, ArmId{1});
    finished(way, at(2s));
  }
  JobId a{0}, b{0}, way{0}, back{0};
};

TEST(DeadlockUnderPark, ChecksTheRetreatThenTheBlockedJob) {
  Parking bench;
  ASSERT_TRUE(bench.question);
  EXPECT_EQ(bench.question->candidates.front().step.job, JobId{0})
      << "a motion that is not yet a job";
  EXPECT_EQ(bench.question->candidates.front().trajectory->arms(), std::vector{ArmId{1}});
  EXPECT_NEAR(bench.question->candidates.front().trajectory->goal()[0], -1.0, 1e-9);
  bench.answer_free(at(3ms));
  ASSERT_TRUE(bench.question);
  EXPECT_EQ(bench.question->candidates.front().step.job, bench.a);
  EXPECT_NEAR(bench.question->rest[1], -1.0, 1e-9) << "the arm has gone";
  EXPECT_DOUBLE_EQ(bench.question->rest[0], 0.0);
  EXPECT_THAT(bench.asides, IsEmpty());
}

TEST(DeadlockUnderPark, RetreatAndReturnAreServerInitiatedJobs) {
  Parking bench;
  bench.answer_way_and_passing();
  for (const YieldMove& aside : bench.asides) {
    EXPECT_EQ(aside.arm, ArmId{1});
    EXPECT_EQ(aside.blocked_job, bench.a);
    EXPECT_TRUE(aside.in_ring);
  }
  EXPECT_FALSE(bench.asides[0].returns);
  EXPECT_TRUE(bench.asides[1].returns);
  EXPECT_NEAR(bench.job(bench.way).trajectory->goal()[0], -1.0, 1e-9);
  EXPECT_NEAR(bench.job(bench.back).trajectory->goal()[0], 0.0, 1e-9);
  EXPECT_TRUE(bench.job(bench.way).job->system_job);
}

TEST(DeadlockUnderPark, NoJobFailsWhileARetreatIsChecked) {
  Parking bench;
  EXPECT_THAT(bench.job(bench.a).job->ring, ElementsAre(bench.a, bench.b));
  for (const auto now : {3ms, 100ms, 5000ms}) bench.step(Wake{}, at(now));
  bench.answer_free(at(5001ms));
  for (const auto now : {5100ms, 9000ms}) bench.step(Wake{}, at(now));
  EXPECT_EQ(bench.state(bench.a), JobState::backlogged);
  EXPECT_EQ(bench.state(bench.b), JobState::backlogged);
  bench.answer_free(at(9001ms));
  bench.step(Wake{}, at(9100ms));
  EXPECT_EQ(bench.state(bench.b), JobState::backlogged);
}

TEST(DeadlockUnderPark, LastJobFailsIfEveryRetreatIsRejected) {
  Parking bench;
  bench.answer_conflict(at(3ms), Conflict::With::scene);  // b's arm cannot retreat
  ASSERT_TRUE(bench.question);
  EXPECT_EQ(bench.question->candidates.front().trajectory->arms(), std::vector{ArmId{0}});
  EXPECT_EQ(bench.state(bench.b), JobState::backlogged);
  bench.answer_free(at(4ms));
  bench.answer_conflict(at(5ms), Conflict::With::rest, {},
                        ArmId{0});  // b would still collide with a's arm there
  EXPECT_EQ(bench.job(bench.b).reason(), Reason::deadlock);
  EXPECT_EQ(bench.state(bench.a), JobState::backlogged);
  EXPECT_THAT(bench.asides, IsEmpty());
}

TEST(DeadlockUnderPark, StoppedArmDoesNotRetreat) {
  Parking bench;
  bench.step(Stop{{ArmId{1}}, "operator"}, at(3ms));
  bench.answer_free(at(4ms));
  EXPECT_THAT(bench.asides, IsEmpty());
  EXPECT_EQ(bench.state(bench.b), JobState::backlogged);
}

TEST(DeadlockUnderPark, RetreatAndReturnComeBeforeTheJob) {
  Parking bench;
  bench.answer_way_and_passing();
  EXPECT_THAT(bench.job(bench.a).job->ring, IsEmpty());
  EXPECT_THAT(bench.job(bench.b).job->ring, IsEmpty());
  ASSERT_FALSE(bench.job(bench.b).waits_on.empty());
  EXPECT_EQ(bench.job(bench.b).waits_on.front().kind, Wait::Kind::predecessor);
  EXPECT_EQ(bench.job(bench.b).waits_on.front().job, bench.back);
  ASSERT_FALSE(bench.job(bench.back).waits_on.empty());
  EXPECT_EQ(bench.job(bench.back).waits_on.front().job, bench.way);
  ASSERT_TRUE(bench.question);
  EXPECT_EQ(bench.question->candidates.front().step.job, bench.way);
}

TEST(DeadlockUnderPark, PredictedRestIsUnchangedByARetreat) {
  Parking bench;
  const JobId next = bench.submit(move({1}, 1, 2, 1s), at(2ms));
  const Configuration before = predicted_rest(bench.scheduler.state());
  EXPECT_DOUBLE_EQ(before[1], 2.0);
  bench.answer_way_and_passing();
  EXPECT_EQ(predicted_rest(bench.scheduler.state()), before);
  bench.step(Cancel{next}, at(5ms));
  EXPECT_DOUBLE_EQ(predicted_rest(bench.scheduler.state())[1], 1.0);
  bench.step(Cancel{bench.b}, at(6ms));
  EXPECT_NEAR(predicted_rest(bench.scheduler.state())[1], 0.0, 1e-9);
}

TEST(DeadlockUnderPark, ReturnWaitsForTheBlockedJob) {
  Parking bench;
  bench.go_aside();
  EXPECT_EQ(bench.state(bench.way), JobState::succeeded);
  ASSERT_TRUE(bench.question);
  ASSERT_EQ(bench.question->candidates.front().step.job, bench.a);
  EXPECT_EQ(bench.job(bench.back).waits_on.front().kind, Wait::Kind::predecessor);
  EXPECT_EQ(bench.job(bench.back).waits_on.front().job, bench.a);
  bench.answer_conflict(at(2001ms), Conflict::With::scene);  // something else blocks a for now
  EXPECT_FALSE(bench.question) << "no other job may be checked";
  bench.step(Wake{}, at(20s));
  EXPECT_EQ(bench.state(bench.back), JobState::queued);
}

TEST(DeadlockUnderPark, ReturnIsCheckedWhenTheBlockedJobIsAdmitted) {
  Parking bench;
  bench.go_aside();
  bench.answer_free(at(2001ms));
  EXPECT_EQ(bench.state(bench.a), JobState::scheduled);
  ASSERT_TRUE(bench.question);
  EXPECT_EQ(bench.question->candidates.front().step.job, bench.back);
}

TEST(DeadlockUnderPark, ReturnIsCheckedWhenTheBlockedJobIsCanceled) {
  Parking bench;
  bench.go_aside();
  bench.step(Cancel{bench.a}, at(2001ms));
  bench.answer_free(at(2002ms));  // stale: about the canceled job
  ASSERT_TRUE(bench.question);
  EXPECT_EQ(bench.question->candidates.front().step.job, bench.back);
}

TEST(DeadlockUnderPark, ReturnIsCheckedWhenTheBlockedJobFails) {
  Parking bench;
  bench.go_aside();
  bench.answer_conflict(at(2001ms), Conflict::With::self);
  EXPECT_EQ(bench.state(bench.a), JobState::failed);
  ASSERT_TRUE(bench.question);
  EXPECT_EQ(bench.question->candidates.front().step.job, bench.back);
}

TEST(DeadlockUnderPark, CycleWithARetreatFailsOnlyTheRetreat) {
  Parking bench;
  bench.answer_way_and_passing();
  bench.answer_conflict(at(6ms), Conflict::With::rest, {},
                        ArmId{0});  // the retreat waits for a's arm
  EXPECT_THAT(bench.job(bench.a).job->ring, ElementsAre(bench.a, bench.way));
  EXPECT_EQ(bench.asides.size(), 2u);
  bench.step(Wake{}, at(7ms));
  EXPECT_EQ(bench.job(bench.way).reason(), Reason::deadlock);
  EXPECT_EQ(bench.job(bench.back).reason(), Reason::predecessor_failed);
  EXPECT_EQ(bench.state(bench.a), JobState::backlogged);
  EXPECT_EQ(bench.state(bench.b), JobState::backlogged);
}

TEST(DeadlockUnderPark, ReturnInACycleNoLongerWaitsForTheBlockedJob) {
  Parking bench;
  bench.go_aside();
  bench.answer_conflict(at(2001ms), Conflict::With::rest, {}, ArmId{1});  // still in its way
  EXPECT_THAT(bench.job(bench.a).job->ring, ElementsAre(bench.a, bench.back));
  bench.step(Wake{}, at(2002ms));
  EXPECT_FALSE(is_terminal(bench.state(bench.a)));
  EXPECT_FALSE(is_terminal(bench.state(bench.back)));
  EXPECT_THAT(bench.job(bench.a).job->ring, IsEmpty());
  ASSERT_TRUE(bench.question);
  EXPECT_EQ(bench.question->candidates.front().step.job, bench.back);
}

// The retreat lets no job pass any more, but a client's job relies on the return.
TEST(DeadlockUnderPark, CycleClosedAgainByTheReturnFailsTheBlockedJob) {
  Parking bench;
  bench.go_aside();
  bench.answer_conflict(at(2001ms), Conflict::With::rest, {}, ArmId{1});
  bench.step(Wake{}, at(2002ms));
  bench.answer_conflict(at(2003ms), Conflict::With::rest, {}, ArmId{0});
  EXPECT_THAT(bench.job(bench.back).job->ring, ElementsAre(bench.back, bench.a));
  bench.answer_conflict(at(2004ms), Conflict::With::scene);  // a's arm cannot retreat
  EXPECT_EQ(bench.job(bench.a).reason(), Reason::deadlock);
  EXPECT_EQ(bench.state(bench.back), JobState::backlogged);
  EXPECT_FALSE(is_terminal(bench.state(bench.b)));
}

// A client's job starts at the end of the retreat.
TEST(DeadlockUnderPark, RetreatThatAClientReliesOnIsKept) {
  Bench bench(one_joint_arms_that_park(2), "certified");
  const JobId a = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  bench.answer_conflict(at(1ms), Conflict::With::rest, {}, ArmId{1});
  bench.answer_free(at(2ms));  // the retreat
  bench.answer_free(at(3ms));  // a's check with the arm gone
  ASSERT_EQ(bench.asides.size(), 1u);
  const JobId way = bench.asides[0].job;
  const JobId counts = bench.submit(move({1}, -1, 0.5, 2s), at(3ms));
  bench.answer_conflict(at(4ms), Conflict::With::rest, {}, ArmId{0});
  EXPECT_THAT(bench.job(a).job->ring, ElementsAre(a, way));
  bench.answer_conflict(at(5ms), Conflict::With::scene);  // a's arm cannot retreat
  EXPECT_EQ(bench.job(a).reason(), Reason::deadlock);
  EXPECT_EQ(bench.state(way), JobState::backlogged);
  EXPECT_FALSE(is_terminal(bench.state(counts)));
}

}  // namespace
}  // namespace armloom
