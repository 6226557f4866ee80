// Defect cases T6 and T7 of DESIGN.md, section 1, on simulated time.
#include <gtest/gtest.h>

#include "test/scenarios/crossing.h"

namespace armloom {
namespace {

// Returns the crossing with a third axis far above it, out of reach.
CellDescription crossing_and_far() {
  CellDescription description = crossing_description();
  RobotDescription far = description.robots[0];
  far.name = far.arms[0].name = "far";
  far.prefix = "far_";
  far.X_WB.translation().z() = 5.0;
  description.robots.push_back(far);
  return description;
}

void inject(Crossing& cell, FaultRequest fault) {
  ASSERT_TRUE(cell.simulation->executive().faults().inject(fault));
}

// T6. x has left the crossing when y arrives, unless x stalls in the crossing.
TEST(FaultyArm, StallStopsOnlyEndangeredArms) {
  Crossing cell(crossing_and_far(), "certified");
  cell.submit(slide("x", -1, 1, 4, "stalls"));
  cell.run_until(at(700ms));
  cell.submit(slide("y", -1, 1, 8, "endangered"));  // at the origin 2.7 s after x
  cell.submit(slide("far", -1, 1, 8, "unconcerned"));
  cell.run_until(at(1900ms));
  ASSERT_EQ(cell.job("endangered").state, JobState::running);
  inject(cell, {.arm = "x", .kind = ArmFault::Kind::stall, .lasting = 10s});
  cell.run_until(at(8s));
  EXPECT_EQ(cell.job("stalls").state, JobState::running) << "late, not ended";
  EXPECT_EQ(cell.job("endangered").state, JobState::paused);
  EXPECT_EQ(cell.job("endangered").waits_on.front().job, "stalls");
  EXPECT_EQ(cell.job("unconcerned").state, JobState::running);
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("stalls").state, JobState::succeeded);
  EXPECT_EQ(cell.job("endangered").state, JobState::succeeded) << "it goes on by itself";
  EXPECT_NEAR(to_seconds(*cell.job("unconcerned").times.ended_at), 8.7, 0.3) << "undisturbed";
  EXPECT_EQ(cell.simulation->executive().figures().monitor_stops, 0u);
}

TEST(FaultyArm, FaultFailsItsJobAndStopsOnlyEndangeredArms) {
  Crossing cell(crossing_and_far(), "certified");
  cell.submit(slide("x", -1, 1, 4, "faults"));
  cell.run_until(at(700ms));
  cell.submit(slide("y", -1, 1, 8, "endangered"));
  cell.submit(slide("far", -1, 1, 8, "unconcerned"));
  cell.run_until(at(1900ms));
  inject(cell, {.arm = "x", .kind = ArmFault::Kind::fault});
  cell.run_until(at(20s));
  EXPECT_EQ(cell.job("faults").state, JobState::failed);
  EXPECT_EQ(cell.job("faults").reason(), Reason::arm_fault);
  EXPECT_EQ(cell.job("endangered").state, JobState::paused);
  EXPECT_EQ(cell.job("endangered").waits_on.front().arm, "x");
  EXPECT_EQ(cell.job("unconcerned").state, JobState::succeeded);

  // After the resume a job moves the faulty arm away.
  const double stands = cell.log.last[0];
  resume_all(cell.simulation->executive());
  cell.submit(slide("x", stands, 1.5, 4, "taken away"));
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("endangered").state, JobState::succeeded);
}

TEST(FaultyArm, FaultBetweenTwoJobsIsNotLost) {
  for (Duration from = 1990ms; from < 2200ms; from += 1ms) {
    CellDescription description = crossing_description();
    description.robots[0].controller.lag = 20ms;
    Crossing cell(description);
    cell.submit(slide("x", -1, 0, 2, "first"));
    cell.submit(slide("x", 0, -1, 2, "second"));
    inject(cell, {.arm = "x", .kind = ArmFault::Kind::fault, .at = at(from)});
    cell.run_until(at(5s));
    const JobView first = cell.job("first"), second = cell.job("second");
    const JobView& struck = first.state == JobState::failed ? first : second;
    ASSERT_EQ(struck.state, JobState::failed) << to_seconds(from);
    EXPECT_EQ(struck.reason(), Reason::arm_fault);
    EXPECT_GE(*struck.times.ended_at, at(from));
    EXPECT_LE(*struck.times.scheduled_at, *struck.times.ended_at) << to_seconds(from);
  }
}

TEST(FaultyArm, OverrunFailsOnlyItsJob) {
  Crossing cell(crossing_and_far(), "certified");
  cell.submit(slide("x", -1, -0.5, 2, "overruns"));
  cell.submit(slide("far", -1, 1, 8, "unconcerned"));
  inject(cell, {.arm = "x", .kind = ArmFault::Kind::stall, .at = at(1s), .lasting = 1000s});
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("overruns").state, JobState::failed);
  EXPECT_EQ(cell.job("overruns").reason(), Reason::overrun);
  EXPECT_GE(*cell.job("overruns").times.ended_at, at(11s));
  EXPECT_LE(*cell.job("overruns").times.ended_at, at(11500ms)) << "and the way to rest";
  EXPECT_EQ(cell.job("unconcerned").state, JobState::succeeded);
}

TEST(CanceledInMotion, MotionBrakesAndItsReservationShrinks) {
  Crossing cell(crossing_and_far(), "certified");
  cell.submit(slide("x", -1, 1, 4, "canceled"));
  cell.submit(slide("far", -1, 1, 4, "other"));
  cell.submit(slide("y", -1, 1, 4, "waits"));
  cell.run_until(at(800ms));
  ASSERT_EQ(cell.job("waits").state, JobState::backlogged);
  ASSERT_TRUE(cell.simulation->executive().cancel("canceled"));
  EXPECT_TRUE(cell.job("canceled").motion.stopping);
  cell.run_until(at(1500ms));
  EXPECT_EQ(cell.job("canceled").state, JobState::canceled);
  EXPECT_LT(cell.log.last[0], -0.5) << "short of the crossing";
  EXPECT_EQ(cell.job("waits").state, JobState::running) << "the crossing is free now";
  EXPECT_EQ(cell.job("other").state, JobState::running);
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("waits").state, JobState::succeeded);
  EXPECT_NEAR(to_seconds(*cell.job("other").times.ended_at), 4.0, 0.3) << "undisturbed";
}

TEST(InjectedFault, CanBeRemoved) {
  Crossing cell(crossing_and_far(), "certified");
  cell.submit(slide("x", -1, -0.5, 2, "stalls"));
  const auto fault =
      cell.simulation->executive().faults().inject({.arm = "x", .kind = ArmFault::Kind::stall});
  ASSERT_TRUE(fault);
  cell.run_until(at(5s));
  EXPECT_EQ(cell.job("stalls").state, JobState::running);
  ASSERT_TRUE(cell.simulation->executive().faults().remove(*fault));
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("stalls").state, JobState::succeeded);
}

}  // namespace
}  // namespace armloom
