// Found by random_teams_test.cc for the most part.
#include "test/scenarios/crossing.h"

namespace armloom {
namespace {

struct Way {
  std::string arm;
  double from_m, to_m;
};

JobRequest together(const std::vector<Way>& ways, double duration_s, std::string key) {
  JobRequest request{.key = std::move(key), .name = "", .trajectory = {}};
  const std::vector<double> zero(ways.size(), 0.0);
  request.trajectory.points = {{{}, zero, zero, 0.0}, {{}, zero, zero, duration_s}};
  for (const Way& way : ways) {
    request.trajectory.joint_names.push_back(way.arm + "_slide");
    request.trajectory.points[0].positions.push_back(way.from_m);
    request.trajectory.points[1].positions.push_back(way.to_m);
  }
  return request;
}

// Returns a copy of the robot, renamed and displaced.
RobotDescription moved(RobotDescription robot, const std::string& name,
                       const Eigen::Vector3d& by_m) {
  robot.name = robot.arms[0].name = name;
  robot.prefix = name + "_";
  robot.X_WB.translation() += by_m;
  return robot;
}

double between_x_and_y_m(const Crossing& cell) { return cell.log.last.head(2).norm() - 0.2; }

// z stalls just before x enters the crossing. x gets a little ahead of z and rests in the crossing
// when their job is canceled. The job's progress is that of z.
TEST(CoordinatedMultiArm, ArmAheadOfItsMotionBlocksWhereItRests) {
  for (Duration stalls = 900ms; stalls < 1500ms; stalls += 20ms) {
    CellDescription description = crossing_description();
    description.robots.push_back(moved(description.robots[0], "z", {0, 5, 0}));
    Crossing cell(description, "coordinated");
    ASSERT_TRUE(cell.simulation->executive().faults().inject(
        {.arm = "z", .kind = ArmFault::Kind::stall, .at = at(stalls)}));
    cell.submit(together({{"x", -1, 1}, {"z", -1, 1}}, 2.2, "team"));
    cell.submit(slide("y", -1, 1, 4, "follows"));
    cell.run_until(at(2500ms));
    ASSERT_TRUE(cell.simulation->executive().cancel("team"));
    double closest_m = 1e9;
    while (cell.simulation->now() < at(9s)) {
      cell.simulation->tick();
      closest_m = std::min(closest_m, between_x_and_y_m(cell));
    }
    EXPECT_GT(closest_m, 0.015) << "stalled at " << to_seconds(stalls) << " s";
    EXPECT_EQ(cell.simulation->executive().figures().monitor_stops, 0U);
  }
}

// In step the two arms pass each other closely. They would touch if they were as far out of step as
// a stall can bring them.
TEST(CoordinatedMultiArm, ArmsOutOfStepKeepClearOfEachOther) {
  for (const double head_start_m : {0.30, 0.34, 0.38, 0.42, 0.46, 0.50}) {
    Crossing cell(crossing_description(), "coordinated");
    cell.submit(slide("x", -1, -1 + head_start_m, 1, "sets out"));
    cell.run_to_the_end();
    ASSERT_TRUE(cell.simulation->executive().faults().inject({.arm = "x",
                                                              .kind = ArmFault::Kind::stall,
                                                              .at = cell.simulation->now() + 900ms,
                                                              .lasting = 2s}));
    cell.submit(together({{"x", -1 + head_start_m, 1}, {"y", -1, 1 - head_start_m}}, 2, "team"));
    cell.run_to_the_end();
    EXPECT_GT(cell.log.closest_m, 0.015) << "head start " << head_start_m << " m";
    EXPECT_EQ(cell.simulation->executive().figures().monitor_stops, 0U);
  }
}

// The paths cross, but in step the arms keep 15 cm apart. So the swept volumes of the arms of one
// motion need not be disjoint.
TEST(CoordinatedMultiArm, PathsMayCrossUnderEveryPolicy) {
  for (const char* policy : {"sequential", "lockstep", "reservation", "timed_discrete", "certified",
                             "earliest_start", "coordinated"}) {
    Crossing cell(crossing_description(), policy);
    cell.submit(slide("x", -1, -0.5, 1, "sets out"));
    cell.submit(together({{"x", -0.5, 1}, {"y", -1, 0.5}}, 4, "team"));
    cell.run_to_the_end();
    const auto team = cell.simulation->executive().job("team");
    EXPECT_EQ(team->state, JobState::succeeded) << policy << ": " << team->detail();
    EXPECT_GT(cell.log.closest_m, 0.1) << policy;
  }
}

// y is paused before x, which was canceled in y's way. Only one job would move x away. It also
// moves y, so it comes after y's motion.
TEST(CoordinatedMultiArm, PausedMotionClosesADeadlockCycle) {
  Crossing cell(crossing_description(), "coordinated");
  cell.submit(slide("x", -1, 1, 4, "canceled"));
  cell.submit(slide("y", -1, 1, 4, "pauses"));
  cell.run_until(at(1950ms));
  ASSERT_TRUE(cell.simulation->executive().cancel("canceled"));
  cell.submit(slide("y", 1, 0.8, 2, "between"));
  cell.run_until(at(5s));
  cell.submit(together({{"x", cell.log.last[0], -1}, {"y", 0.8, 1}}, 2, "both"));
  cell.run_until(at(6s));
  EXPECT_EQ(cell.job("both").state, JobState::failed);
  EXPECT_EQ(cell.job("both").reason(), Reason::deadlock);
  EXPECT_EQ(cell.job("pauses").state, JobState::paused);
  cell.submit(slide("x", cell.log.last[0], -1, 3, "makes way"));
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("pauses").state, JobState::succeeded);
  EXPECT_EQ(cell.job("between").state, JobState::succeeded);
}

TEST(CoordinatedMultiArm, StopOfAPausedMotionKeepsTheDeadlockCycle) {
  Crossing cell(crossing_description(), "coordinated");
  cell.submit(slide("x", -1, 1, 4, "canceled"));
  cell.submit(slide("y", -1, 1, 4, "pauses"));
  cell.run_until(at(1950ms));
  ASSERT_TRUE(cell.simulation->executive().cancel("canceled"));
  cell.run_until(at(5s));
  cell.simulation->executive().stop({ArmId{1}}, "operator");
  cell.submit(together({{"x", cell.log.last[0], -1}, {"y", 1, 0.8}}, 2, "both"));
  cell.run_until(at(6s));
  EXPECT_EQ(cell.job("both").state, JobState::queued);
  resume_all(cell.simulation->executive());
  cell.run_until(at(7s));
  EXPECT_EQ(cell.job("pauses").state, JobState::paused);
  EXPECT_EQ(cell.job("both").reason(), Reason::deadlock);
}

// x leaves the crossing together with z. y is paused before x. w is paused before y's path, and
// blocks z there.
TEST(CoordinatedMultiArm, StopBeforeTheStartKeepsTheOrder) {
  CellDescription description = crossing_description();
  description.robots.push_back(moved(description.robots[1], "z", {-0.3, 0, 0}));
  description.robots.back().arms[0].home = {0.3};
  description.robots.push_back(moved(description.robots[0], "w", {0, 0.6, 0}));
  description.scheduling.aging = 1s;  // after 1 s y's job can no longer be overtaken
  Crossing cell(description, "coordinated");
  Executive& executive = cell.simulation->executive();
  cell.submit(slide("x", -1, 0, 1, "in the middle"));
  cell.submit(together({{"x", 0, 1}, {"z", 0.3, 1}}, 2, "leaves"));
  cell.run_until(at(500ms));
  ASSERT_TRUE(
      executive.faults().inject({.arm = "x", .kind = ArmFault::Kind::late_start, .value = 5}));
  ASSERT_TRUE(
      executive.faults().inject({.arm = "z", .kind = ArmFault::Kind::late_start, .value = 5}));
  cell.run_until(at(1100ms));  // x is in the crossing
  cell.submit(slide("y", -1, 1, 3, "follows"));
  cell.run_until(at(3s));
  ASSERT_EQ(cell.job("in the middle").state, JobState::succeeded);
  ASSERT_FALSE(cell.job("leaves").times.started_at);
  executive.stop({ArmId{2}}, "operator");
  cell.submit(slide("w", -1, 1, 12, "last"));
  cell.run_until(at(10s));
  ASSERT_EQ(cell.job("last").state, JobState::paused);
  resume_all(executive);
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("follows").state, JobState::succeeded);
  EXPECT_EQ(cell.job("last").state, JobState::succeeded);
  EXPECT_EQ(cell.job("leaves").state, JobState::succeeded);
}

}  // namespace
}  // namespace armloom
