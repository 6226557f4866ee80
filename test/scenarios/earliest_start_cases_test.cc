// Jobs under earliest_start, and late arms (T5), through the executive on simulated time.
#include <gtest/gtest.h>

#include "test/scenarios/crossing.h"

namespace armloom {
namespace {

double seconds(const std::optional<TimePoint>& time) { return to_seconds(*time); }

TEST(EarliestStart, FinishesCrossingJobsSoonerThanCertified) {
  struct Run {
    double end_s, start_s, closest_m;
  };
  const auto run = [](const char* policy) {
    Crossing cell(crossing_description(), policy);
    cell.submit(slide("x", -1, 1, 4, "first"));
    cell.submit(slide("y", -1, 1, 4, "second"));
    cell.run_to_the_end();
    EXPECT_EQ(cell.job("first").state, JobState::succeeded);
    EXPECT_EQ(cell.job("second").state, JobState::succeeded);
    return Run{to_seconds(cell.simulation->executive().figures().last_end),
               seconds(cell.job("second").times.started_at), cell.log.closest_m};
  };
  const Run certified = run("certified"), earliest = run("earliest_start");
  EXPECT_GE(certified.start_s, 4.0);
  EXPECT_LT(earliest.end_s, certified.end_s - 2.5);
  EXPECT_GE(certified.closest_m, 0.02);
  EXPECT_GE(earliest.closest_m, 0.02) << "the cell's clearance";
}

TEST(EarliestStart, IsPublishedInAdvanceAndKept) {
  Crossing cell(crossing_description(), "earliest_start");
  cell.submit(slide("x", -1, 1, 4, "first"));
  cell.submit(slide("y", -1, 1, 4, "second"));
  cell.run_until(at(100ms));
  const JobView told = cell.job("second");
  EXPECT_EQ(told.state, JobState::scheduled);
  ASSERT_TRUE(told.times.scheduled_at);
  ASSERT_EQ(told.waits_on.size(), 1u);
  EXPECT_EQ(told.waits_on.front().job, "first");
  cell.run_to_the_end();
  EXPECT_NEAR(seconds(cell.job("second").times.started_at), seconds(told.times.scheduled_at), 0.02);
}

TEST(EarliestStart, MovesForwardIfTheBlockerIsCanceled) {
  Crossing cell(crossing_description(), "earliest_start");
  cell.submit(slide("x", -1, 1, 10, "first"));
  cell.submit(slide("y", -1, 1, 10, "second"));
  cell.run_until(at(300ms));
  const JobView before = cell.job("second");
  ASSERT_EQ(before.state, JobState::scheduled);
  ASSERT_GT(seconds(before.times.scheduled_at), 0.8);
  ASSERT_TRUE(cell.simulation->executive().cancel("first"));
  cell.run_until(at(700ms));
  EXPECT_EQ(cell.job("second").state, JobState::running);
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("second").state, JobState::succeeded);
  EXPECT_GE(cell.log.closest_m, 0.02);
}

class LateArm : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Late, LateArm,
                         ::testing::Values("certified", "earliest_start", "coordinated"));

TEST_P(LateArm, TouchesNothingAndEveryJobSucceeds) {
  // T5. The other job is timed so that both would meet if the server trusted clocks.
  for (Duration when = 0ms; when <= 5s; when += 250ms) {
    for (const FaultRequest& fault :
         {FaultRequest{.arm = "x", .kind = ArmFault::Kind::late_start, .value = 2.0},
          FaultRequest{.arm = "x", .kind = ArmFault::Kind::slow, .value = 0.3}}) {
      SCOPED_TRACE(std::to_string(to_seconds(when)) + " s, " +
                   (fault.kind == ArmFault::Kind::slow ? "slow" : "late"));
      Crossing cell(crossing_description(), GetParam());
      ASSERT_TRUE(cell.simulation->executive().faults().inject(fault));
      cell.submit(slide("x", -1, 1, 4, "off its plan"));
      cell.run_until(at(when));
      cell.submit(slide("y", -1, 1, 4, "other"));
      cell.run_to_the_end();
      EXPECT_EQ(cell.job("off its plan").state, JobState::succeeded);
      EXPECT_EQ(cell.job("other").state, JobState::succeeded);
      EXPECT_GT(cell.log.closest_m, 0.0);
      EXPECT_EQ(cell.simulation->executive().figures().monitor_stops, 0u);
    }
  }
}

}  // namespace
}  // namespace armloom
