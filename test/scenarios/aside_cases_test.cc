// An arm without a job rests in another job's way. Depending on on_idle_blocker the server reports
// the arm or moves it away and back (retreat).
#include <set>

#include "test/scenarios/polygon.h"

namespace armloom {
namespace {

CellDescription parking(OnIdleBlocker on_idle_blocker) {
  CellDescription cell = crossing_description();
  cell.scheduling.on_idle_blocker = on_idle_blocker;
  return cell;
}

class Retreat : public ::testing::TestWithParam<std::string> {
 protected:
  // Brings x to rest in the crossing and submits a job of y that wants to pass.
  void start(OnIdleBlocker on_idle_blocker) {
    cell.emplace(parking(on_idle_blocker), GetParam());
    cell->submit(slide("x", -1, 0, 2, "in the middle"));
    cell->run_until(at(3s));
    ASSERT_EQ(cell->job("in the middle").state, JobState::succeeded);
    cell->submit(slide("y", -1, 1, 3, "passes"));
  }
  std::optional<Crossing> cell;
};
INSTANTIATE_TEST_SUITE_P(Policies, Retreat, ::testing::ValuesIn(known_policies()));

TEST_P(Retreat, IsSuggestedIfAnIdleArmBlocksAJob) {
  start(OnIdleBlocker::report);
  cell->run_until(at(10s));
  const JobView waits = cell->job("passes");
  EXPECT_EQ(waits.state, JobState::backlogged);
  ASSERT_FALSE(waits.waits_on.empty());
  EXPECT_EQ(waits.waits_on[0].kind, Wait::Kind::arm);
  EXPECT_EQ(waits.waits_on[0].arm, "x");
  EXPECT_EQ(
      waits.waits_on[0].detail,
      "arm x has no job: move it away with another job, or set \"on_idle_blocker\": \"park\" or "
      "\"replan\" in the cell's scheduling, so that it retreats if a path is free");
}

TEST_P(Retreat, IsSuggestedInTheReasonOfAnExpiredJob) {
  start(OnIdleBlocker::report);
  cell->run_to_the_end(at(80s));
  const JobView expired = cell->job("passes");
  ASSERT_EQ(expired.reason(), Reason::backlog_timeout);
  EXPECT_EQ(expired.detail().rfind("waited 60 s in the backlog; arm x has no job: ", 0), 0u)
      << expired.detail();
}

// x is canceled in the crossing, at y's goal. Then the job "both" must start where x has not
// arrived. x retreats at most once, and the job reports why it cannot start.
TEST_P(Retreat, IsNotRepeatedForAJobThatStartsElsewhere) {
  cell.emplace(parking(OnIdleBlocker::park), GetParam());
  cell->submit(slide("x", -1, 1, 4, "canceled"));
  cell->submit(slide("y", -1, 0, 2, "into"));
  JobRequest both = slide("x", 1, -1, 3, "both");
  both.trajectory.joint_names.push_back("y_slide");
  both.trajectory.points = {{{1, 0}, {0, 0}, {0, 0}, 0.0}, {{-1, -1}, {0, 0}, {0, 0}, 3.0}};
  cell->submit(both);
  while (cell->log.last[0] < -0.05) cell->simulation->tick();
  ASSERT_TRUE(cell->simulation->executive().cancel("canceled"));
  cell->run_until(at(100s));
  // under timed_discrete the monitor stops y where x is canceled
  if (GetParam() != "timed_discrete") {
    EXPECT_EQ(cell->job("into").state, JobState::succeeded);
    EXPECT_EQ(cell->job("both").reason(), Reason::start_mismatch);
  }
  std::set<std::string> retreats;
  for (const JobView& job : cell->simulation->executive().snapshot().jobs) {
    if (job.key.starts_with("retreat-")) retreats.insert(job.key);
  }
  EXPECT_LE(retreats.size(), 1U);
}

TEST_P(Retreat, IsNotSuggestedIfAJobWillMoveTheArm) {
  start(OnIdleBlocker::report);
  cell->run_until(at(10s));
  cell->submit(slide("y", 1, -1, 3, "back"));
  EXPECT_FALSE(cell->job("passes").waits_on[0].detail.empty());
  cell->submit(slide("x", 0, 1, 2, "leaves"));
  for (const WaitView& wait : cell->job("passes").waits_on) EXPECT_EQ(wait.detail, "");
}

TEST_P(Retreat, TakesAnIdleArmBackWhereItCameFrom) {
  start(OnIdleBlocker::park);
  cell->run_to_the_end(at(20s));
  EXPECT_EQ(cell->job("passes").state, JobState::succeeded);
  const JobView aside = cell->job("retreat-1");
  EXPECT_EQ(aside.state, JobState::succeeded);
  EXPECT_EQ(aside.name, "x retreats for passes");
  EXPECT_NEAR(cell->log.last[0], -1.0, 1e-3);
  EXPECT_GT(cell->log.closest_m, 0.01);
}

TEST_P(Retreat, IsReversedForAJobThatStartsAtTheOldPosition) {
  start(OnIdleBlocker::park);
  cell->run_to_the_end(at(20s));
  // The second job counts on the return before the first.
  ASSERT_TRUE(submit_batch(cell->simulation->executive(),
                           {slide("x", 0, 0.5, 2, "goes on"), slide("x", 0.5, 1, 2, "then")},
                           true));
  cell->run_to_the_end(at(40s));
  EXPECT_EQ(cell->job("retreat-2").name, "x returns to where it was left");
  EXPECT_EQ(cell->job("retreat-2").state, JobState::succeeded);
  EXPECT_EQ(cell->job("then").state, JobState::succeeded);
  EXPECT_NEAR(cell->log.last[0], 1.0, 1e-3);
}

TEST_P(Retreat, IsNotReversedForAJobThatStartsAtTheNewPosition) {
  start(OnIdleBlocker::park);
  cell->run_to_the_end(at(20s));
  cell->submit(slide("x", -1, 1, 2, "from here"));
  cell->run_to_the_end(at(40s));
  EXPECT_EQ(cell->job("from here").state, JobState::succeeded);
  EXPECT_FALSE(cell->simulation->executive().job("retreat-2"));
}

TEST_P(Retreat, IsReportedAsImpossibleWithoutAFreePose) {
  CellDescription description = parking(OnIdleBlocker::park);
  description.robots[0].arms[0].home = {0.0};
  cell.emplace(description, GetParam());
  cell->submit(slide("y", -1, 1, 3, "passes"));
  cell->run_until(at(10s));
  const JobView waits = cell->job("passes");
  EXPECT_EQ(waits.state, JobState::backlogged);
  EXPECT_FALSE(cell->simulation->executive().job("retreat-1"));
  ASSERT_FALSE(waits.waits_on.empty());
  EXPECT_EQ(waits.waits_on[0].detail,
            "arm x has no job: no free retreat was found (back along its last motion, home, or to "
            "a named pose of its group); move it away with another job to unblock this one, or set "
            "\"on_idle_blocker\": \"replan\", so that retreats are planned");
  cell->run_to_the_end(at(600s));
  const JobView expired = cell->job("passes");
  EXPECT_EQ(expired.reason(), Reason::backlog_timeout);
  EXPECT_TRUE(expired.detail().ends_with(
      "; arm x has no job: no free retreat was found (back along its last motion, home, or to a "
      "named pose of its group); moving it away with another job would have unblocked this one"))
      << expired.detail();
}

TEST_P(Retreat, WaitsForTheResumeOfAStoppedArm) {
  start(OnIdleBlocker::report);
  cell->simulation->executive().stop({ArmId{0}}, "operator");
  cell->run_until(at(10s));
  EXPECT_EQ(cell->job("passes").waits_on.at(0).detail,
            "arm x is stopped and has no job: resume it and move it away with another job, or set "
            "\"on_idle_blocker\": \"park\" or \"replan\" in the cell's scheduling, so that it "
            "retreats if a path is free when it is resumed");

  cell.emplace(parking(OnIdleBlocker::park), GetParam());
  cell->submit(slide("x", -1, 0, 2, "in the middle"));
  cell->run_until(at(3s));
  cell->simulation->executive().stop({ArmId{0}}, "operator");
  cell->submit(slide("y", -1, 1, 3, "passes"));
  cell->run_until(at(10s));
  EXPECT_EQ(cell->job("passes").state, JobState::backlogged);
  EXPECT_EQ(cell->job("passes").waits_on.at(0).detail,
            "arm x is stopped and has no job: when it is resumed it retreats if a path is free "
            "(back along its last motion, home, or to a named pose of its group); otherwise move "
            "it away with another job to unblock this one");
  cell->submit(slide("x", 0, 1, 2, "leaves"));
  for (const WaitView& wait : cell->job("passes").waits_on) {
    if (wait.arm != "x" || wait.kind != Wait::Kind::arm) continue;
    EXPECT_EQ(wait.detail, "arm x is stopped: resume it, and its own job will move it away");
  }
  ASSERT_TRUE(cell->simulation->executive().cancel("leaves"));
  cell->simulation->executive().resume({ArmId{0}});
  cell->run_to_the_end(at(40s));
  EXPECT_EQ(cell->job("passes").state, JobState::succeeded);
  EXPECT_EQ(cell->job("retreat-1").state, JobState::succeeded);
}

TEST(RetreatByDefault, IsOn) {
  EXPECT_EQ(CellDescription{}.scheduling.on_idle_blocker, OnIdleBlocker::park);
}

TEST_P(Retreat, ContinuesToTheEndOfThePathIfTheWayBackIsBlocked) {
  cell.emplace(parking(OnIdleBlocker::park), GetParam());
  CollisionObject behind{.name = "behind", .shape = Sphere{0.1}};
  behind.X_WO.translation().x() = -0.5;
  cell->submit(slide("x", -1, 0.5, 4, "canceled"));
  while (cell->log.last[0] < -0.1) cell->simulation->tick();
  ASSERT_TRUE(cell->simulation->executive().cancel("canceled"));
  ASSERT_TRUE(cell->simulation->executive().scene().add(behind));
  cell->run_until(cell->simulation->now() + 1s);
  cell->submit(slide("y", -1, 1, 3, "passes"));
  cell->run_to_the_end(at(30s));
  EXPECT_EQ(cell->job("passes").state, JobState::succeeded);
  EXPECT_NEAR(cell->log.last[0], 0.5, 1e-3);
}

}  // namespace
}  // namespace armloom
