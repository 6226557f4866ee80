#include <gmock/gmock.h>

#include "test/scheduler/bench_cell.h"

namespace armloom {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

TEST(Resume, WaitingJobReportsItsOriginalBlockerAgain) {
  Bench bench(2, "certified");
  const JobId job = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  bench.answer_conflict(at(1ms), Conflict::With::rest, {}, ArmId{1});
  bench.step(Stop{{ArmId{0}}, "operator"}, at(2ms));
  ASSERT_THAT(bench.job(job).waits_on, SizeIs(1));
  EXPECT_EQ(bench.job(job).waits_on.front().kind, Wait::Kind::stop);
  bench.step(Resume{{ArmId{0}}}, at(3ms));
  ASSERT_TRUE(bench.question) << "it is checked again";
  ASSERT_THAT(bench.job(job).waits_on, SizeIs(1));
  EXPECT_EQ(bench.job(job).waits_on.front().kind, Wait::Kind::arm);
}

TEST(Resume, BrakingJobNoLongerWaitsForTheStop) {
  Bench bench(1);
  const JobId job = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  bench.answer_free(at(1ms));
  bench.progressed(job, 1ms, at(2ms));
  bench.step(Stop{{ArmId{0}}, "operator"}, at(3ms));
  ASSERT_THAT(bench.job(job).waits_on, SizeIs(1));
  bench.step(Resume{{ArmId{0}}}, at(4ms));
  EXPECT_THAT(bench.job(job).waits_on, IsEmpty());
}

// The other motion has passed, but the arm has not reported yet that it goes on.
TEST(Resume, BrakingJobNoLongerRestsForAMotionThatHasPassed) {
  OneBehindAnother two(ProgressBox{1500ms, 1800ms, 0ms, 1200ms});
  Bench& bench = two.bench;
  bench.progressed(two.second, 900ms, at(2s));
  for (const auto now : {3s, 4s}) bench.progressed(two.second, 1500ms - kShortOf, at(now));
  ASSERT_TRUE(bench.job(two.second).pausing());
  bench.progressed(two.first, 1300ms, at(5s));
  ASSERT_GT(bench.authority(two.second), 1500ms);
  bench.step(Stop{{ArmId{1}}, "operator"}, at(5001ms));
  EXPECT_FALSE(bench.job(two.second).pausing()) << "it may move";
  bench.step(Resume{{ArmId{1}}}, at(5002ms));
  EXPECT_FALSE(bench.job(two.second).pausing());
  EXPECT_THAT(bench.job(two.second).waits_on, IsEmpty());
}

TEST(Resume, OfOneTeamArmLeavesTheJobWaitingForTheOther) {
  Bench bench(2);
  bench.step(Stop{{ArmId{0}, ArmId{1}}, "operator"}, at(0ms));
  const JobId job = bench.submit(move({0, 1}, 0, 1, 2s), at(1ms));
  bench.step(Resume{{ArmId{0}}}, at(2ms));
  ASSERT_THAT(bench.job(job).waits_on, SizeIs(1));
  EXPECT_EQ(bench.job(job).waits_on.front().arm, ArmId{1});
}

// A job whose arm comes to rest `off_rad` beside its path.
struct OffPath : Bench {
  explicit OffPath(double off, MoveToStart move_to_start = MoveToStart::none)
      : Bench(1), off_rad(off) {
    job = submit(Submit{.job = JobId{0},
                        .trajectory = move({0}, 0, 1, 2s),
                        .terms = {.move_to_start = move_to_start}},
                 at(0ms));
    answer_free(at(1ms));
    progressed(job, 500ms, at(501ms));
  }
  void come_to_rest() {
    Eigen::VectorXd position;
    scheduler.find(job)->trajectory->sample_positions(600ms, position);
    position[0] += off_rad;
    Bench::step(
        MotionReport{only_step(job), MotionReport::Kind::stopped, 600ms, position, "", 600ms},
        at(700ms));
  }
  void stop_and_resume() {
    Bench::step(Stop{{ArmId{0}}, "monitor"}, at(600ms));
    come_to_rest();
    EXPECT_EQ(state(job), JobState::paused);
    Bench::step(Resume{{ArmId{0}}}, at(800ms));
  }
  double off_rad;
  JobId job{0};
};

TEST(Resume, FailsAJobWhoseArmRestsBesideItsPath) {
  OffPath bench(0.02);
  bench.stop_and_resume();
  EXPECT_EQ(bench.state(bench.job), JobState::failed);
  EXPECT_EQ(bench.Bench::job(bench.job).reason(), Reason::start_mismatch);
}

TEST(Resume, ReplansAJobWhoseArmRestsBesideItsPath) {
  OffPath bench(0.02, MoveToStart::plan);
  bench.stop_and_resume();
  EXPECT_EQ(bench.state(bench.job), JobState::paused);
  ASSERT_THAT(bench.plans, SizeIs(1));
}

TEST(Resume, ContinuesAJobWhoseArmRestsCloseToItsPath) {
  OffPath bench(0.009);
  bench.stop_and_resume();
  EXPECT_EQ(bench.state(bench.job), JobState::paused);
  ASSERT_TRUE(bench.question);
  EXPECT_NEAR(bench.question->candidates.front().off_path, 0.009, 1e-9);
}

// Its orders were made with the region of a motion that is closer to its path.
TEST(Resume, DecidesTheOrdersOfAnArmBesideItsPathAnew) {
  OneBehindAnother two(ProgressBox{1500ms, 1600ms, 1700ms, 1800ms});
  Bench& bench = two.bench;
  bench.progressed(two.second, 500ms, at(1003ms));
  bench.step(Stop{{ArmId{1}}, "monitor"}, at(1100ms));
  Eigen::VectorXd position;
  bench.job(two.second).trajectory->sample_positions(600ms, position);
  position[0] += 0.009;
  bench.step(
      MotionReport{only_step(two.second), MotionReport::Kind::stopped, 600ms, position, "", 600ms},
      at(1200ms));
  bench.step(Resume{{ArmId{1}}}, at(1300ms));
  ASSERT_TRUE(bench.question);
  bench.answer_regions(at(1301ms), {{only_step(two.second),
                                     only_step(two.first),
                                     {region(ProgressBox{900ms, 1600ms, 1700ms, 1800ms})}}});
  EXPECT_GT(bench.authority(two.second), 600ms);
  EXPECT_LE(bench.authority(two.second), 900ms);
}

// The arm of another motion is not where the orders assume. The guard sees that, and the motion
// rests.
TEST(Refused, DropsTheAuthorityThatTheGuardRefused) {
  OneBehindAnother two(ProgressBox{1500ms, 1600ms, 1700ms, 1800ms});
  Bench& bench = two.bench;
  bench.progressed(two.second, 500ms, at(1003ms));
  EXPECT_GT(bench.authority(two.second), 800ms);
  bench.step(Refused{only_step(two.second), ArmId{0}, "the guard"}, at(2003ms));
  EXPECT_THAT(bench.braked, ElementsAre(two.second));
  bench.stopped(two.second, 500ms, at(2004ms));
  EXPECT_EQ(bench.state(two.second), JobState::paused);
  EXPECT_FALSE(bench.question) << "nothing has changed";
  ASSERT_THAT(bench.job(two.second).waits_on, SizeIs(1));
  EXPECT_EQ(bench.job(two.second).waits_on[0].kind, Wait::Kind::guard);
  bench.step(SceneChanged{}, at(2005ms));
  bench.answer_regions(at(2006ms), {{only_step(two.second),
                                     only_step(two.first),
                                     {region(ProgressBox{700ms, 1600ms, 1700ms, 1800ms})}}});
  EXPECT_LE(bench.dispatched.back().authority, 700ms);
}

TEST(Refused, PutsAJobThatHasNotMovedInTheBacklog) {
  Bench bench(1);
  const JobId job = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  bench.answer_free(at(1ms));
  bench.step(Refused{only_step(job), std::nullopt, "the guard"}, at(1001ms));
  bench.stopped(job, 0ms, at(1002ms));
  EXPECT_EQ(bench.state(job), JobState::backlogged);
  EXPECT_THAT(bench.released, ElementsAre(job));
  EXPECT_FALSE(bench.question);
  bench.step(SceneChanged{}, at(1003ms));
  EXPECT_TRUE(bench.question);
}

TEST(Refused, IsCanceledWhileItBrakes) {
  Bench bench(1);
  const JobId job = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  bench.answer_free(at(1ms));
  bench.progressed(job, 500ms, at(504ms));
  bench.step(Refused{only_step(job), std::nullopt, "the guard"}, at(1504ms));
  bench.step(Stop{{ArmId{0}}, "operator"}, at(1505ms));
  bench.step(Cancel{job}, at(1506ms));
  bench.stopped(job, 500ms, at(1507ms));
  EXPECT_EQ(bench.state(job), JobState::canceled);
}

TEST(Resume, UsesThePositionFoundAtTheResume) {
  OffPath bench(0.02);
  bench.step(Stop{{ArmId{0}}, "monitor"}, at(600ms));
  bench.come_to_rest();
  Eigen::VectorXd position;
  bench.Bench::job(bench.job).trajectory->sample_positions(600ms, position);
  bench.step(Located{ArmId{0}, position}, at(750ms));
  bench.step(Resume{{ArmId{0}}}, at(800ms));
  EXPECT_EQ(bench.state(bench.job), JobState::paused);
}

TEST(Resume, ComparesAnArmThatPausesWithoutAStopAtOnce) {
  OffPath bench(0.02);
  bench.step(SetSpeed{std::nullopt, 0.0}, at(600ms));
  bench.come_to_rest();
  EXPECT_EQ(bench.state(bench.job), JobState::failed);
  EXPECT_EQ(bench.Bench::job(bench.job).reason(), Reason::start_mismatch);
}

// The motion's progress is that of its last arm.
TEST(Resume, AcceptsAnArmThatRestsAheadOfItsTeam) {
  Bench bench(2);
  const JobId job = bench.submit(move({0, 1}, 0, 1, 2s), at(0ms));
  bench.answer_free(at(1ms));
  bench.progressed(job, 900ms, at(901ms));
  bench.step(Stop{{ArmId{0}}, "operator"}, at(902ms));
  const TrajectoryPtr& motion = bench.job(job).trajectory;
  Eigen::VectorXd position, ahead;
  motion->sample_positions(950ms, position);
  motion->sample_positions(980ms, ahead);
  ASSERT_GT(ahead[1] - position[1], 0.02);
  position[1] = ahead[1];
  bench.step(MotionReport{only_step(job), MotionReport::Kind::stopped, 950ms, position, "", 980ms},
             at(1s));
  bench.step(Resume{{ArmId{0}}}, at(2s));
  EXPECT_EQ(bench.state(job), JobState::paused);
}

// ---- What happens between a decision and the arm ----

// A job is dispatched, and the scene changes before it moves.
struct InQuestion : Bench {
  InQuestion() : Bench(1) {
    job = submit(move({0}, 0, 1, 2s), at(0ms));
    answer_free(at(1ms));
    step(SceneChanged{{ArmId{0}}}, at(2ms));
  }
  JobId job{0};
};

TEST(BeforeItMoves, ANewObjectKeepsTheJobFromStarting) {
  InQuestion bench;
  bench.answer_conflict(at(3ms), Conflict::With::scene);
  EXPECT_THAT(bench.braked, ElementsAre(bench.job));
  bench.stopped(bench.job, 0ms, at(4ms));
  EXPECT_THAT(bench.dispatched, SizeIs(1));
  bench.answer_conflict(at(5ms), Conflict::With::scene);
  EXPECT_THAT(bench.dispatched, SizeIs(1));
  EXPECT_EQ(bench.state(bench.job), JobState::queued);
}

TEST(BeforeItMoves, ASelfCollisionBrakesItFirst) {
  InQuestion bench;
  bench.answer_conflict(at(3ms), Conflict::With::self);
  EXPECT_THAT(bench.braked, ElementsAre(bench.job));
  bench.stopped(bench.job, 0ms, at(4ms));
  EXPECT_EQ(bench.state(bench.job), JobState::failed);
  EXPECT_THAT(bench.released, ElementsAre(bench.job));
}

TEST(BeforeItMoves, AMovedArmDoesNotStart) {
  Bench bench(1);
  const JobId job = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  bench.answer_free(at(1ms));
  bench.step(Stop{{ArmId{0}}, "operator"}, at(2ms));
  bench.stopped(job, 0ms, at(3ms));
  Eigen::VectorXd position(1);
  position << 0.5;
  bench.step(Located{ArmId{0}, position}, at(500ms));
  bench.step(Resume{{ArmId{0}}}, at(1s));
  EXPECT_THAT(bench.dispatched, SizeIs(1));
  EXPECT_EQ(bench.state(job), JobState::failed);
  EXPECT_EQ(bench.job(job).reason(), Reason::start_mismatch);
}

TEST(Resume, FailsAJobBesideItsPathIfNoPathIsFound) {
  OffPath bench(0.02, MoveToStart::plan);
  bench.stop_and_resume();
  ASSERT_THAT(bench.plans, SizeIs(1));
  bench.step(PlanMade{only_step(bench.job), bench.plans[0].number, nullptr, {"none"}}, at(900ms));
  EXPECT_EQ(bench.state(bench.job), JobState::failed);
  EXPECT_EQ(bench.Bench::job(bench.job).reason(), Reason::start_mismatch);
}

TEST(Stop, OfAStoppedArmLeavesOtherChecksValid) {
  Bench bench(2);
  bench.step(Stop{{ArmId{0}}, "operator"}, at(0ms));
  const JobId job = bench.submit(move({1}, 0, 1, 2s), at(1ms));
  bench.step(Stop{{ArmId{0}}, "operator"}, at(2ms));
  bench.step(SetSpeed{std::nullopt, 1.0}, at(3ms));
  bench.answer_free(at(4ms));
  EXPECT_EQ(bench.state(job), JobState::scheduled);
}

// The rest of a canceled job holds another motion. The arm is then moved by hand.
TEST(Located, FreesMotionsThatTheArmHeld) {
  OneBehindAnother two(ProgressBox{1500ms, 1600ms, 300ms, 900ms});
  Bench& bench = two.bench;
  bench.step(Cancel{two.first}, at(504ms));
  bench.stopped(two.first, 600ms, at(600ms));
  bench.progressed(two.second, 500ms, at(1003ms));
  Eigen::VectorXd position(1);
  position << -1.0;
  bench.step(Located{ArmId{0}, position}, at(2s));
  ASSERT_THAT(bench.braked, ElementsAre(two.first, two.second));
  bench.stopped(two.second, 500ms, at(2100ms));
  EXPECT_TRUE(bench.question) << "new orders are decided";
}

}  // namespace
}  // namespace armloom
