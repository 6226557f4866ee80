#include "core/model/promises.h"

#include <gtest/gtest.h>

#include "test/model/test_cells.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;

TEST(Promises, DefaultsGiveTheMinimums) {
  const Promises promises = promises_of(ControllerDescription{});
  EXPECT_EQ(promises.free_run(), Promises::kFreeRunMin);
  EXPECT_EQ(promises.stands_from(), Promises::kStandsFromMin);
  EXPECT_EQ(promises.pace_from(), Promises::kPaceFromMin);
  EXPECT_EQ(promises.report_age(), Promises::kReportAgeMin);
  EXPECT_EQ(promises.out_of_step(), Promises::kOutOfStepMin);
  EXPECT_EQ(promises.until_told(), 2ms);
  EXPECT_EQ(promises.overrun_margin(500ms), 500ms);
}

TEST(Promises, SlowControllersGetLongerTimes) {
  const Promises promises{.reaction = 200ms, .feedback_period = 50ms, .feedback_timeout = 1s};
  EXPECT_EQ(promises.free_run(), 1s + 1ms + 200ms + 80ms);
  EXPECT_EQ(promises.stands_from(), 1s + 1ms + 200ms);
  EXPECT_EQ(promises.pace_from(), 4 * 251ms);
  EXPECT_EQ(promises.report_age(), 251ms);
  EXPECT_EQ(promises.out_of_step(), 502ms);
  EXPECT_EQ(promises.until_told(), 51ms);
  EXPECT_EQ(promises.overrun_margin(500ms), 1201ms);
}

TEST(Promises, OfSeveralArmsAreThoseOfTheSlowestInEachTime) {
  const ControllerDescription usual;
  for (const std::size_t slow : {0, 1}) {
    Cell cell = *build_or_fail(two_pandas_description());
    cell.robots[slow].controller.reaction = 300ms;
    cell.robots[1 - slow].controller.feedback_period = 40ms;
    cell.robots[slow].controller.feedback_timeout = 2s;
    const ArmId arms[] = {ArmId{0}, ArmId{1}};
    const Promises both = promises_of(cell, arms);
    EXPECT_EQ(both.reaction, 300ms);
    EXPECT_EQ(both.feedback_period, 40ms);
    EXPECT_EQ(both.feedback_timeout, 2s);
    const Promises quick = promises_of(cell, {&arms[1 - slow], 1});
    EXPECT_EQ(quick.reaction, usual.reaction);
    EXPECT_EQ(quick.feedback_timeout, usual.feedback_timeout);
  }
}

TEST(Promises, TrackingErrorOfARobotReplacesThatOfTheCell) {
  Cell cell = *build_or_fail(two_pandas_description());
  cell.robots[1].controller.tracking_error_rad = 0.004;
  EXPECT_EQ(cell.tracking_error(RobotId{0}), cell.checking.tracking_error_rad);
  EXPECT_EQ(cell.tracking_error(RobotId{1}), 0.004);
}

}  // namespace
}  // namespace armloom
