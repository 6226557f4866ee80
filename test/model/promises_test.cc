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
  Cell cell = *build_or_fail(two_pandas_description());
  cell.robots[0].controller.reaction = 300ms;
  cell.robots[1].controller.feedback_period = 40ms;
  const ArmId both[] = {ArmId{0}, ArmId{1}};
  EXPECT_EQ(promises_of(cell, both).response(), 341ms);
  EXPECT_EQ(promises_of(cell, {&both[0], 1}).response(), 302ms);
}

TEST(Promises, TrackingErrorOfARobotReplacesThatOfTheCell) {
  Cell cell = *build_or_fail(two_pandas_description());
  cell.robots[1].controller.tracking_error_rad = 0.004;
  EXPECT_EQ(cell.tracking_error(RobotId{0}), cell.checking.tracking_error_rad);
  EXPECT_EQ(cell.tracking_error(RobotId{1}), 0.004);
}

}  // namespace
}  // namespace armloom
