// Deadlocks in the scheduler: found when they arise, named, and resolved: by arms that go aside, or
// by a job that fails.
#include <gmock/gmock.h>

#include "core/trajectory/joint_line.h"
#include "test/scheduler/bench_cell.h"

namespace armloom {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// Each of two arms stands where the other one's job would go.
struct Swap : Bench {
  Swap() : Bench(3, "certified") {
    a = submit(move({0}, 0, 1, 2s), at(0ms));
    b = submit(move({1}, 0, 1, 2s), at(0ms));
    answer_conflict(at(1ms), Conflict::With::rest, {}, ArmId{1});
    answer_conflict(at(2ms), Conflict::With::rest, {}, ArmId{0});
  }
  JobId a{0}, b{0};
};

TEST(Deadlock, OfTwoIsNamedInTheStepThatFindsItAndNobodyHasFailedYet) {
  Swap bench;
  EXPECT_THAT(bench.job(bench.a).ring, ElementsAre(bench.a, bench.b));
  EXPECT_THAT(bench.job(bench.b).ring, ElementsAre(bench.b, bench.a));
  EXPECT_EQ(bench.state(bench.a), JobState::backlogged);
  EXPECT_EQ(bench.state(bench.b), JobState::backlogged);
  ASSERT_TRUE(bench.wake_at);
  EXPECT_LE(*bench.wake_at, at(3ms));
}

TEST(Deadlock, TheJobThatCameLastFailsAndTheOtherWaitsForItsArm) {
  Swap bench;
  bench.step(Wake{}, at(3ms));
  EXPECT_EQ(bench.state(bench.b), JobState::failed);
  EXPECT_EQ(bench.job(bench.b).reason(), Reason::deadlock);
  EXPECT_THAT(bench.job(bench.b).ring, ElementsAre(bench.b, bench.a)) << "kept, as the reason";
  EXPECT_EQ(bench.terminal_events[bench.b], 1);
  EXPECT_EQ(bench.state(bench.a), JobState::backlogged);
  EXPECT_THAT(bench.job(bench.a).ring, IsEmpty());
  ASSERT_TRUE(bench.question);
  bench.answer_conflict(at(4ms), Conflict::With::rest, {}, ArmId{1});
  EXPECT_EQ(bench.job(bench.a).waits_on.front().kind, Wait::Kind::arm);
  EXPECT_THAT(bench.job(bench.a).ring, IsEmpty()) << "an arm without a job closes no ring";
  bench.step(Wake{}, at(1s));
  EXPECT_EQ(bench.state(bench.a), JobState::backlogged);
}

// Stopped beside each other on their ways, so that neither can go on.
TEST(Deadlock, OfTwoThatStandOnTheirPathsIsNamedToo) {
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
  EXPECT_THAT(bench.job(a).ring, IsEmpty()) << "the other one may be able to go";
  bench.answer_conflict(at(1003ms), Conflict::With::rest, {}, ArmId{0});
  EXPECT_THAT(bench.job(a).ring, ElementsAre(a, b));
  bench.step(Wake{}, at(1004ms));
  EXPECT_EQ(bench.job(b).reason(), Reason::deadlock);
  bench.answer_free(at(1005ms));
  EXPECT_EQ(bench.state(a), JobState::scheduled);
}

TEST(Deadlock, ACanceledJobOpensTheRing) {
  Swap bench;
  bench.step(Cancel{bench.a}, at(3ms));
  EXPECT_THAT(bench.job(bench.a).ring, IsEmpty());
  EXPECT_EQ(bench.state(bench.b), JobState::backlogged);
  EXPECT_THAT(bench.job(bench.b).ring, IsEmpty());
  EXPECT_FALSE(bench.job(bench.b).reason());
}

TEST(Deadlock, OnAnotherSceneIsJudgedAgainBeforeAnyoneFails) {
  Swap bench;
  bench.step(SceneChanged{}, at(3ms));
  EXPECT_THAT(bench.job(bench.b).ring, IsEmpty());
  bench.answer_free(at(4ms));
  EXPECT_EQ(bench.state(bench.a), JobState::scheduled);
  EXPECT_EQ(bench.state(bench.b), JobState::backlogged);
}

TEST(Deadlock, OfThreeAmongOthersThatMove) {
  Bench bench(4, "certified");
  const JobId moves = bench.submit(move({3}, 0, 1, 20s), at(0ms));
  bench.answer_free(at(1ms));
  const JobId a = bench.submit(move({0}, 0, 1, 2s), at(2ms));
  bench.answer_conflict(at(3ms), Conflict::With::rest, {}, ArmId{1});
  const JobId b = bench.submit(move({1}, 0, 1, 2s), at(4ms));
  bench.answer_conflict(at(5ms), Conflict::With::rest, {}, ArmId{2});
  EXPECT_THAT(bench.job(b).ring, IsEmpty());
  const JobId c = bench.submit(move({2}, 0, 1, 2s), at(6ms));
  bench.answer_conflict(at(7ms), Conflict::With::rest, {}, ArmId{0});
  EXPECT_THAT(bench.job(a).ring, ElementsAre(a, b, c));
  EXPECT_THAT(bench.job(b).ring, ElementsAre(b, c, a));
  EXPECT_THAT(bench.job(c).ring, ElementsAre(c, a, b));
  bench.progressed(moves, 0ms, at(8ms));
  bench.step(Wake{}, at(9ms));
  EXPECT_EQ(bench.state(c), JobState::failed);
  EXPECT_EQ(bench.state(moves), JobState::running);
}

TEST(Deadlock, ThroughAPredecessor) {
  // a waits for arm b to go, whose only job comes after a.
  Bench bench(2, "certified");
  const JobId a = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  bench.answer_conflict(at(1ms), Conflict::With::rest, {}, ArmId{1});
  bench.step(Submit{JobId{2}, move({1}, 0, 1, 2s), 0, 60s, {a}}, at(2ms));
  EXPECT_THAT(bench.job(a).ring, ElementsAre(a, JobId{2}));
  bench.step(Wake{}, at(3ms));
  EXPECT_EQ(bench.job(JobId{2}).reason(), Reason::deadlock);
  EXPECT_EQ(bench.state(a), JobState::backlogged);
}

TEST(Deadlock, IsNoneWhileOneOfTheTwoMovesOrWaitsForWhatMoves) {
  Bench bench(3, "certified");
  const JobId runs = bench.submit(move({2}, 0, 1, 2s), at(0ms));
  bench.answer_free(at(1ms));
  const JobId a = bench.submit(move({0}, 0, 1, 2s), at(2ms));
  bench.answer_conflict(at(3ms), Conflict::With::rest, {}, ArmId{1});
  const JobId b = bench.submit(move({1}, 0, 1, 2s), at(4ms));
  bench.answer_conflict(at(5ms), Conflict::With::motion, runs, ArmId{2});
  EXPECT_THAT(bench.job(a).ring, IsEmpty());
  EXPECT_THAT(bench.job(b).ring, IsEmpty());
}

TEST(Deadlock, AStopBreaksTheSearchForIt) {
  Bench bench(2, "certified");
  bench.step(Stop{{ArmId{1}}, "operator"}, at(0ms));
  const JobId a = bench.submit(move({0}, 0, 1, 2s), at(1ms));
  const JobId b = bench.submit(move({1}, 0, 1, 2s), at(1ms));
  bench.answer_conflict(at(2ms), Conflict::With::rest, {}, ArmId{1});
  EXPECT_FALSE(bench.question);
  EXPECT_THAT(bench.job(a).ring, IsEmpty());
  EXPECT_EQ(bench.job(b).waits_on.front().kind, Wait::Kind::stop);
}

// ---- Arms of a ring go aside (scheduling.on_idle_blocker "park") ----

// As Swap: b's arm could go aside before b, and is asked about at once.
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
  // The arm stands aside; nothing is decided about a since then.
  void go_aside() {
    answer_way_and_passing();
    ASSERT_EQ(question->candidates.front().job, way);
    answer_free(at(5ms));
    progressed(way, 0ms, at(10ms));
    if (question) answer_conflict(at(11ms), Conflict::With::motion, way, ArmId{1});
    finished(way, at(2s));
  }
  JobId a{0}, b{0}, way{0}, back{0};
};

TEST(RingUnderPark, AsksForTheWayAndThenForThePassingBeforeAnythingElse) {
  Parking bench;
  ASSERT_TRUE(bench.question);
  EXPECT_EQ(bench.question->candidates.front().job, JobId{0}) << "a motion that is no job yet";
  EXPECT_EQ(bench.question->candidates.front().trajectory->arms(), std::vector{ArmId{1}});
  EXPECT_NEAR(bench.question->candidates.front().trajectory->goal()[0], -1.0, 1e-9);
  bench.answer_free(at(3ms));
  ASSERT_TRUE(bench.question);
  EXPECT_EQ(bench.question->candidates.front().job, bench.a);
  EXPECT_NEAR(bench.question->rest[1], -1.0, 1e-9) << "the arm has gone";
  EXPECT_DOUBLE_EQ(bench.question->rest[0], 0.0);
  EXPECT_THAT(bench.asides, IsEmpty());
}

TEST(RingUnderPark, TheArmGoesAsideAndComesBackByJobsOfTheSchedulersOwn) {
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
  EXPECT_TRUE(bench.job(bench.way).system_job);
}

TEST(RingUnderPark, NobodyFailsWhileAWayIsAskedFor) {
  Parking bench;
  EXPECT_THAT(bench.job(bench.a).ring, ElementsAre(bench.a, bench.b));
  for (const auto now : {3ms, 100ms, 5000ms}) bench.step(Wake{}, at(now));
  bench.answer_free(at(5001ms));
  for (const auto now : {5100ms, 9000ms}) bench.step(Wake{}, at(now));
  EXPECT_EQ(bench.state(bench.a), JobState::backlogged);
  EXPECT_EQ(bench.state(bench.b), JobState::backlogged);
  bench.answer_free(at(9001ms));
  bench.step(Wake{}, at(9100ms));
  EXPECT_EQ(bench.state(bench.b), JobState::backlogged);
}

TEST(RingUnderPark, WhenEveryWayIsRefusedTheLastJobFails) {
  Parking bench;
  bench.answer_conflict(at(3ms), Conflict::With::scene);  // b's arm cannot go
  ASSERT_TRUE(bench.question);
  EXPECT_EQ(bench.question->candidates.front().trajectory->arms(), std::vector{ArmId{0}});
  EXPECT_EQ(bench.state(bench.b), JobState::backlogged);
  bench.answer_free(at(4ms));
  bench.answer_conflict(at(5ms), Conflict::With::rest, {}, ArmId{0});  // b would find it there too
  EXPECT_EQ(bench.job(bench.b).reason(), Reason::deadlock);
  EXPECT_EQ(bench.state(bench.a), JobState::backlogged);
  EXPECT_THAT(bench.asides, IsEmpty());
}

TEST(RingUnderPark, AStoppedArmGoesNowhere) {
  Parking bench;
  bench.step(Stop{{ArmId{1}}, "operator"}, at(3ms));
  bench.answer_free(at(4ms));
  EXPECT_THAT(bench.asides, IsEmpty());
  EXPECT_EQ(bench.state(bench.b), JobState::backlogged);
}

TEST(RingUnderPark, ThePairTakesItsPlaceBeforeTheJob) {
  Parking bench;
  bench.answer_way_and_passing();
  EXPECT_THAT(bench.job(bench.a).ring, IsEmpty());
  EXPECT_THAT(bench.job(bench.b).ring, IsEmpty());
  ASSERT_FALSE(bench.job(bench.b).waits_on.empty());
  EXPECT_EQ(bench.job(bench.b).waits_on.front().kind, Wait::Kind::order);
  EXPECT_EQ(bench.job(bench.b).waits_on.front().job, bench.back);
  ASSERT_FALSE(bench.job(bench.back).waits_on.empty());
  EXPECT_EQ(bench.job(bench.back).waits_on.front().job, bench.way);
  ASSERT_TRUE(bench.question);
  EXPECT_EQ(bench.question->candidates.front().job, bench.way);
}

TEST(RingUnderPark, ThePairChangesNothingAboutWhereArmsWillStand) {
  Parking bench;
  const JobId next = bench.submit(move({1}, 1, 2, 1s), at(2ms));
  const Configuration before = bench.scheduler.predicted_rest();
  EXPECT_DOUBLE_EQ(before[1], 2.0);
  bench.answer_way_and_passing();
  EXPECT_EQ(bench.scheduler.predicted_rest(), before);
  bench.step(Cancel{next}, at(5ms));
  EXPECT_DOUBLE_EQ(bench.scheduler.predicted_rest()[1], 1.0);
  bench.step(Cancel{bench.b}, at(6ms));
  EXPECT_NEAR(bench.scheduler.predicted_rest()[1], 0.0, 1e-9);
}

TEST(RingUnderPark, TheReturnDoesNotBeginWhileTheOtherWaits) {
  Parking bench;
  bench.go_aside();
  EXPECT_EQ(bench.state(bench.way), JobState::succeeded);
  ASSERT_TRUE(bench.question);
  ASSERT_EQ(bench.question->candidates.front().job, bench.a);
  EXPECT_EQ(bench.job(bench.back).waits_on.front().kind, Wait::Kind::order);
  EXPECT_EQ(bench.job(bench.back).waits_on.front().job, bench.a);
  bench.answer_conflict(at(2001ms), Conflict::With::scene);  // for now something else is there
  EXPECT_FALSE(bench.question) << "nobody else may be judged";
  bench.step(Wake{}, at(20s));
  EXPECT_EQ(bench.state(bench.back), JobState::queued);
}

TEST(RingUnderPark, TheReturnIsJudgedWhenTheOtherIsAdmitted) {
  Parking bench;
  bench.go_aside();
  bench.answer_free(at(2001ms));
  EXPECT_EQ(bench.state(bench.a), JobState::scheduled);
  ASSERT_TRUE(bench.question);
  EXPECT_EQ(bench.question->candidates.front().job, bench.back);
}

TEST(RingUnderPark, TheReturnIsJudgedWhenTheOtherIsCanceled) {
  Parking bench;
  bench.go_aside();
  bench.step(Cancel{bench.a}, at(2001ms));
  bench.answer_free(at(2002ms));  // stale: it was about the job that was canceled
  ASSERT_TRUE(bench.question);
  EXPECT_EQ(bench.question->candidates.front().job, bench.back);
}

TEST(RingUnderPark, TheReturnIsJudgedWhenTheOtherFails) {
  Parking bench;
  bench.go_aside();
  bench.answer_conflict(at(2001ms), Conflict::With::self);
  EXPECT_EQ(bench.state(bench.a), JobState::failed);
  ASSERT_TRUE(bench.question);
  EXPECT_EQ(bench.question->candidates.front().job, bench.back);
}

TEST(RingUnderPark, WithAMoveAsideInItFailsThatAndNoClientsJob) {
  Parking bench;
  bench.answer_way_and_passing();
  bench.answer_conflict(at(6ms), Conflict::With::rest, {}, ArmId{0});  // the way waits for a's arm
  EXPECT_THAT(bench.job(bench.a).ring, ElementsAre(bench.a, bench.way));
  EXPECT_EQ(bench.asides.size(), 2u);
  bench.step(Wake{}, at(7ms));
  EXPECT_EQ(bench.job(bench.way).reason(), Reason::deadlock);
  EXPECT_EQ(bench.job(bench.back).reason(), Reason::predecessor_failed);
  EXPECT_EQ(bench.state(bench.a), JobState::backlogged);
  EXPECT_EQ(bench.state(bench.b), JobState::backlogged);
}

TEST(RingUnderPark, WithAReturnInItTheReturnWaitsNoMoreForTheOther) {
  Parking bench;
  bench.go_aside();
  bench.answer_conflict(at(2001ms), Conflict::With::rest, {}, ArmId{1});  // still in its way
  EXPECT_THAT(bench.job(bench.a).ring, ElementsAre(bench.a, bench.back));
  bench.step(Wake{}, at(2002ms));
  EXPECT_FALSE(is_terminal(bench.state(bench.a)));
  EXPECT_FALSE(is_terminal(bench.state(bench.back)));
  EXPECT_THAT(bench.job(bench.a).ring, IsEmpty());
  ASSERT_TRUE(bench.question);
  EXPECT_EQ(bench.question->candidates.front().job, bench.back);
}

// It lets nobody pass any more, but a client's job counts on it all the same.
TEST(RingUnderPark, ThatClosesAgainWithTheReturnFailsTheOtherAndNotTheReturn) {
  Parking bench;
  bench.go_aside();
  bench.answer_conflict(at(2001ms), Conflict::With::rest, {}, ArmId{1});
  bench.step(Wake{}, at(2002ms));
  bench.answer_conflict(at(2003ms), Conflict::With::rest, {}, ArmId{0});
  EXPECT_THAT(bench.job(bench.back).ring, ElementsAre(bench.back, bench.a));
  bench.answer_conflict(at(2004ms), Conflict::With::scene);  // a's arm cannot go aside
  EXPECT_EQ(bench.job(bench.a).reason(), Reason::deadlock);
  EXPECT_EQ(bench.state(bench.back), JobState::backlogged);
  EXPECT_FALSE(is_terminal(bench.state(bench.b)));
}

// A client's job has been sent for where the arm will stand.
TEST(RingUnderPark, WithAMoveAsideThatAClientCountsOnFailsTheOther) {
  Bench bench(one_joint_arms_that_park(2), "certified");
  const JobId a = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  bench.answer_conflict(at(1ms), Conflict::With::rest, {}, ArmId{1});
  bench.answer_free(at(2ms));  // the way
  bench.answer_free(at(3ms));  // the passing
  ASSERT_EQ(bench.asides.size(), 1u);
  const JobId way = bench.asides[0].job;
  const JobId counts = bench.submit(move({1}, -1, 0.5, 2s), at(3ms));
  bench.answer_conflict(at(4ms), Conflict::With::rest, {}, ArmId{0});
  EXPECT_THAT(bench.job(a).ring, ElementsAre(a, way));
  bench.answer_conflict(at(5ms), Conflict::With::scene);  // a's arm cannot go aside
  EXPECT_EQ(bench.job(a).reason(), Reason::deadlock);
  EXPECT_EQ(bench.state(way), JobState::backlogged);
  EXPECT_FALSE(is_terminal(bench.state(counts)));
}

// ---- What is asked of arms has an end ----

// Arm 1 goes aside for a, and for its sake arm 2.
struct Chain : Bench {
  Chain() : Bench(one_joint_arms_that_park(3), "certified") {
    a = submit(move({0}, 0, 1, 2s), at(0ms));
    answer_conflict(at(1ms), Conflict::With::rest, {}, ArmId{1});
    answer_free(at(2ms));  // the way
    answer_free(at(3ms));  // the passing
    way = asides.at(0).job;
    answer_conflict(at(4ms), Conflict::With::rest, {}, ArmId{2});
  }
  // Whether arm 2 is asked about.
  bool asks_for_arm_2() const {
    return question && question->candidates.front().job == JobId{0} &&
           question->candidates.front().trajectory->arms() == std::vector{ArmId{2}};
  }
  JobId a{0}, way{0};
};

TEST(MovingAside, ForWhatHelpsAJobEndsWithThatJob) {
  Chain bench;
  ASSERT_TRUE(bench.asks_for_arm_2());
  bench.step(Cancel{bench.a}, at(5ms));
  bench.answer_free(at(6ms));  // stale
  ASSERT_EQ(bench.question->candidates.front().job, bench.way);
  bench.answer_conflict(at(7ms), Conflict::With::rest, {}, ArmId{2});
  EXPECT_FALSE(bench.question);
  EXPECT_EQ(bench.state(bench.way), JobState::backlogged);
}

// However often arm 1 is sent back by its client, and goes aside again: every other job that helps
// a finds arm 2 asked before.
TEST(MovingAside, ForWhatHelpsAJobCountsAsForThatJob) {
  Chain bench;
  int asked = 0;
  double stands = 0.0;
  std::optional<JobId> sent;
  for (Duration now = 10ms; now < 2s; now += 10ms) {
    if (bench.asks_for_arm_2()) {
      ++asked;
      bench.answer_conflict(at(now), Conflict::With::scene);
    } else if (!bench.question) {
      if (!is_terminal(bench.state(bench.asides.back().job))) {
        bench.step(Cancel{bench.asides.back().job}, at(now));
      }
      sent = bench.submit(move({1}, stands, stands + 0.1, 1s), at(now));
    } else if (const JobId about = bench.question->candidates.front().job; about == sent) {
      bench.answer_free(at(now));
      bench.progressed(*sent, 0ms, at(now));
      bench.finished(*sent, at(now));
      stands += 0.1;
    } else if (about == JobId{0}) {
      bench.answer_free(at(now));
    } else if (about == bench.a && std::abs(bench.question->rest[1] - stands) > 1e-9) {
      bench.answer_free(at(now));  // arm 1 stands aside
    } else {
      bench.answer_conflict(at(now), Conflict::With::rest, {}, ArmId{about == bench.a ? 1u : 2u});
    }
  }
  EXPECT_EQ(asked, 8);
}

}  // namespace
}  // namespace armloom
