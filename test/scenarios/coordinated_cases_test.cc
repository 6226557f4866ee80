// Motions pass each other in the agreed order, pause at the end of their authority, and keep clear,
// whatever happens to the motion that passes first.
#include "test/scenarios/crossing.h"
#include "test/scenarios/star.h"

namespace armloom {
namespace {

struct Coordinated : ::testing::Test {
  Crossing cell{crossing_description(), "coordinated"};
  double position(std::size_t arm) const { return cell.log.last[static_cast<Eigen::Index>(arm)]; }
};

TEST(CoordinatedLate, LateMotionPausesAtTheEndOfItsAuthority) {
  Crossing cell(crossing_description(), "coordinated");
  ASSERT_TRUE(cell.simulation->executive().faults().inject(
      {.arm = "x", .kind = ArmFault::Kind::stall, .at = at(1800ms), .lasting = 3s}));
  cell.submit(slide("x", -1, 1, 4, "first"));
  cell.submit(slide("y", -1, 1, 4, "second"));
  cell.run_until(at(4s));
  const JobView paused = cell.job("second");
  EXPECT_EQ(paused.state, JobState::paused);
  ASSERT_EQ(paused.waits_on.size(), 1U);
  EXPECT_EQ(paused.waits_on[0].job, "first");
  EXPECT_FALSE(paused.waits_on[0].links.empty());
  EXPECT_GT(cell.log.last[1], -0.5) << "it has come near the crossing";
  EXPECT_LT(cell.log.last[1], -0.2) << "and stays out of it";
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("first").state, JobState::succeeded);
  EXPECT_EQ(cell.job("second").state, JobState::succeeded);
  EXPECT_LT(to_seconds(*cell.job("first").times.ended_at), 7.5) << "nobody delays it further";
  EXPECT_LT(to_seconds(*cell.job("second").times.ended_at), 8.5)
      << "it is near when the way is free";
  EXPECT_GT(cell.log.closest_m, 0.015);
}

TEST_F(Coordinated, ShortJobPassesBeforeADistantLongJob) {
  cell.submit(slide("x", -1, 1, 12, "long"));
  cell.run_until(at(500ms));
  cell.submit(slide("y", -1, 1, 3, "short"));
  cell.run_to_the_end();
  EXPECT_LT(to_seconds(*cell.job("short").times.ended_at), 3.7);
  EXPECT_LT(to_seconds(*cell.job("long").times.ended_at), 12.1);
  EXPECT_GT(cell.log.closest_m, 0.015);
}

// T5: the first arm stalls in the crossing.
TEST(CoordinatedLate, MotionWaitsWhileTheFirstMotionStalls) {
  Crossing cell(crossing_description(), "coordinated");
  ASSERT_TRUE(cell.simulation->executive().faults().inject(
      {.arm = "x", .kind = ArmFault::Kind::stall, .at = at(1900ms), .lasting = 6s}));
  cell.submit(slide("x", -1, 1, 4, "stalls"));
  cell.submit(slide("y", -1, 1, 4, "follows"));
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("stalls").state, JobState::succeeded);
  EXPECT_EQ(cell.job("follows").state, JobState::succeeded);
  EXPECT_GT(to_seconds(*cell.job("follows").times.ended_at), 8.0);
  EXPECT_EQ(cell.simulation->executive().figures().monitor_stops, 0U);
  EXPECT_GT(cell.log.closest_m, 0.015);
}

// T7: a canceled arm rests in the crossing.
TEST_F(Coordinated, JobWaitsUntilACanceledArmLeavesTheCrossing) {
  cell.submit(slide("x", -1, 1, 4, "canceled"));
  cell.submit(slide("y", -1, 1, 4, "follows"));
  cell.run_until(at(1950ms));
  ASSERT_TRUE(cell.simulation->executive().cancel("canceled"));
  cell.run_until(at(12s));
  EXPECT_EQ(cell.job("canceled").state, JobState::canceled);
  const JobView waits = cell.job("follows");
  EXPECT_EQ(waits.state, JobState::paused);
  ASSERT_EQ(waits.waits_on.size(), 1U);
  EXPECT_EQ(waits.waits_on[0].kind, Wait::Kind::arm);
  EXPECT_EQ(waits.waits_on[0].arm, "x");
  cell.submit(slide("x", position(0), -1, 3, "back"));
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("back").state, JobState::succeeded);
  EXPECT_EQ(cell.job("follows").state, JobState::succeeded);
  EXPECT_GT(cell.log.closest_m, 0.015);
}

TEST_F(Coordinated, PausedJobExpiresBehindAnIdleArm) {
  cell.submit(slide("x", -1, 1, 4, "canceled"));
  JobRequest follows = slide("y", -1, 1, 4, "follows");
  follows.terms.backlog_timeout = 20s;
  cell.submit(follows);
  cell.run_until(at(1950ms));
  ASSERT_TRUE(cell.simulation->executive().cancel("canceled"));
  cell.run_until(at(20s));
  EXPECT_EQ(cell.job("follows").state, JobState::paused);
  cell.run_to_the_end(at(25s));
  const JobView gave_up = cell.job("follows");
  EXPECT_EQ(gave_up.state, JobState::expired);
  EXPECT_EQ(gave_up.reason(), Reason::backlog_timeout);
  EXPECT_EQ(gave_up.detail(),
            "waited 20 s on its path; arm x has no job: move it away with another job, or set "
            "\"on_idle_blocker\": \"park\" or \"replan\" in the cell's scheduling, so that it "
            "retreats if a path is free");
  ASSERT_EQ(gave_up.waits_on.size(), 1U);
  EXPECT_EQ(gave_up.waits_on[0].arm, "x");
}

// A job behind a canceled job cannot start any more. So no other job may rely on the departure of
// that job's arm.
TEST_F(Coordinated, JobDoesNotRelyOnAJobWhoseStartIsNotReached) {
  cell.submit(slide("x", -1, 0, 3, "into the crossing"));
  cell.submit(slide("x", 0, 0.5, 2, "on"));
  cell.submit(slide("x", 0.5, 1, 2, "home"));
  cell.run_until(at(2s));
  ASSERT_TRUE(cell.simulation->executive().cancel("on"));
  cell.submit(slide("y", -1, 1, 5, "waits"));
  cell.run_until(at(20s));
  EXPECT_EQ(cell.job("home").state, JobState::failed);
  EXPECT_NE(cell.job("waits").state, JobState::succeeded) << "x rests in the crossing";
  EXPECT_GT(cell.log.closest_m, 0.015);
  EXPECT_EQ(cell.simulation->executive().figures().monitor_stops, 0U);
  stop_all(cell.simulation->executive(), "operator");
  cell.run_until(at(21s));
  resume_all(cell.simulation->executive());
  cell.run_until(at(30s));
  EXPECT_GT(cell.log.closest_m, 0.015);
  cell.submit(slide("x", 0, -1, 3, "makes way"));
  cell.run_to_the_end(at(100s));
  EXPECT_EQ(cell.job("waits").state, JobState::succeeded);
  EXPECT_GT(cell.log.closest_m, 0.015);
}

TEST_F(Coordinated, PassingOrderSurvivesStopAndResume) {
  cell.submit(slide("x", -1, 1, 4, "first"));
  cell.submit(slide("y", -1, 1, 4, "second"));
  cell.run_until(at(1500ms));
  stop_all(cell.simulation->executive(), "operator");
  cell.run_until(at(4s));
  EXPECT_EQ(cell.job("first").state, JobState::paused);
  EXPECT_EQ(cell.job("second").state, JobState::paused);
  resume_all(cell.simulation->executive());
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("first").state, JobState::succeeded);
  EXPECT_EQ(cell.job("second").state, JobState::succeeded);
  EXPECT_GT(cell.log.closest_m, 0.015);
}

// The executive dies in mid-motion. Every controller brakes by itself before the end of its
// authority. That end is certified against the rests of all other arms.
TEST(ExecutiveDeath, LeavesEveryArmAtRestWithoutContact) {
  for (std::size_t arms = 2; arms <= 4; ++arms) {
    for (Duration dies = 100ms; dies < 7s; dies += 150ms) {
      SmallestDistance closest(arms);
      auto cell = build_cell(star(arms));
      auto created = Simulation::create(
          *cell, ExecutiveOptions{.policy = "coordinated", .dies_at = at(dies)}, closest);
      Simulation& simulation = **created;
      simulation.tick();
      for (std::size_t i = 0; i < arms; ++i) {
        const std::string arm(1, static_cast<char>('a' + i));
        ASSERT_TRUE(
            simulation.executive().submit(slide(arm, -1, 1, 3.0 + 0.3 * static_cast<double>(i))));
        ASSERT_TRUE(simulation.executive().submit(slide(arm, 1, -1, 2.5)));
      }
      simulation.run_until(at(dies + 2s));
      const Configuration rests = closest.last;
      simulation.run_until(at(dies + 3s));
      EXPECT_EQ(closest.last, rests) << arms << " arms, died at " << to_seconds(dies) << " s";
      EXPECT_GT(closest.smallest_m, 0.015) << arms << " arms, died at " << to_seconds(dies)
                                           << " s, contact at " << to_seconds(closest.when) << " s";
      EXPECT_FALSE(simulation.executive().all_ended() && dies < 3s) << "it had not died";
    }
  }
}

// Returns a motion of x and y. In the next two tests this motion begins or ends with x in the
// crossing.
JobRequest both(double x_from_m, double x_to_m, double y_from_m, double y_to_m, std::string key) {
  JobRequest request = slide("x", x_from_m, x_to_m, 2, std::move(key));
  request.trajectory.joint_names.push_back("y_slide");
  request.trajectory.points[0].positions.push_back(y_from_m);
  request.trajectory.points[1].positions.push_back(y_to_m);
  for (auto& point : request.trajectory.points) {
    point.velocities = point.accelerations = {0.0, 0.0};
  }
  return request;
}

TEST_F(Coordinated, JobDoesNotRelyOnADepartureThatComesLater) {
  cell.submit(slide("x", -1, 0, 2, "in the middle"));
  cell.run_until(at(1800ms));
  cell.submit(slide("y", -1, 1, 4, "passes"));
  cell.submit(both(0, 1, 1, 0.9, "both"));
  cell.run_until(at(10s));
  EXPECT_GT(cell.log.closest_m, 0.015);
  EXPECT_EQ(cell.job("in the middle").state, JobState::succeeded);
  EXPECT_EQ(cell.job("passes").state, JobState::backlogged);
  EXPECT_EQ(cell.simulation->executive().figures().monitor_stops, 0U);
}

// The reverse case: `both` brings x into the crossing, and x leaves much later.
TEST_F(Coordinated, JobDoesNotPassFirstAStartThatIsReachedEarlier) {
  cell.submit(both(-1, 0, -1, -0.9, "both"));
  cell.submit(slide("x", 0, 1, 20, "leaves"));
  cell.submit(slide("y", -0.9, 1, 2, "passes"));
  cell.run_to_the_end();
  EXPECT_GT(cell.log.closest_m, 0.015);
  for (const char* key : {"both", "leaves", "passes"}) {
    EXPECT_EQ(cell.job(key).state, JobState::succeeded) << key;
  }
  EXPECT_EQ(cell.simulation->executive().figures().monitor_stops, 0U);
}

}  // namespace
}  // namespace armloom
