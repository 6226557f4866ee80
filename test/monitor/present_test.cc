#include "core/monitor/present.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armloom {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;
using Kind = MonitorFinding::Kind;

const ArmId kLeft{0};
const ArmId kRight{1};
const std::vector<bool> kBothMove{true, true};
const std::vector<bool> kLeftMoves{true, false};
const std::vector<bool> kNoneMoves{false, false};

Proximity hands(double clearance_m) {
  return {.body_a = "left_hand",
          .body_b = "right_hand",
          .arm_a = kLeft,
          .arm_b = kRight,
          .object_b = false,
          .clearance_m = clearance_m,
          .limit_m = 0.01};
}
Proximity hand_and_table(double clearance_m) {
  return {.body_a = "right_hand",
          .body_b = "table",
          .arm_a = kRight,
          .arm_b = std::nullopt,
          .object_b = true,
          .clearance_m = clearance_m,
          .limit_m = 0.01};
}

TEST(PresentCheck, FindsNothingWhileAllPairsKeepTheClearance) {
  PresentCheck m;
  EXPECT_THAT(m.observe({}, kBothMove, at(10ms)), IsEmpty());
}

TEST(PresentCheck, ReportsPairDistanceAndTimeAndStopsBothMovingArms) {
  PresentCheck m;
  const auto found = m.observe({hands(0.006)}, kBothMove, at(30ms));
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found[0].kind, Kind::clearance);
  EXPECT_EQ(found[0].time, at(30ms));
  EXPECT_EQ(found[0].limit_m, 0.01);
  EXPECT_EQ(found[0].proximity.body_b, "right_hand");
  EXPECT_EQ(found[0].proximity.clearance_m, 0.006);
  EXPECT_THAT(found[0].stops, ElementsAre(kLeft, kRight));
}

TEST(PresentCheck, ReportsContactAtZeroDistance) {
  PresentCheck m;
  EXPECT_EQ(m.observe({hands(1e-9)}, kBothMove, at(0ms)).at(0).kind, Kind::clearance);
  EXPECT_EQ(PresentCheck().observe({hands(0.0)}, kBothMove, at(0ms)).at(0).kind, Kind::contact);
  EXPECT_EQ(PresentCheck().observe({hands(-0.003)}, kBothMove, at(0ms)).at(0).kind, Kind::contact);
}

TEST(PresentCheck, StopsOnlyTheMovingArmOfAPair) {
  PresentCheck m;
  EXPECT_THAT(m.observe({hands(0.006)}, kLeftMoves, at(0ms)).at(0).stops, ElementsAre(kLeft));
  // The right hand is too close to the table. The table cannot be stopped, and the left arm is not
  // involved.
  EXPECT_THAT(m.observe({hand_and_table(0.004)}, kBothMove, at(10ms)).at(0).stops,
              ElementsAre(kRight));
}

TEST(PresentCheck, ListsAnArmTooCloseToItselfOnce) {
  Proximity self = hands(0.001);
  self.arm_b = kLeft;
  self.limit_m = 0.0025;
  const auto found = PresentCheck().observe({self}, kBothMove, at(0ms));
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_THAT(found[0].stops, ElementsAre(kLeft));
  EXPECT_EQ(found[0].limit_m, 0.0025);
}

TEST(PresentCheck, ReportsArmsAtRestWithoutStoppingThem) {
  PresentCheck m;
  const auto found = m.observe({hands(0.006)}, kNoneMoves, at(0ms));
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_THAT(found[0].stops, IsEmpty());
}

TEST(PresentCheck, ReportsAPairOnlyOnce) {
  PresentCheck m;
  EXPECT_THAT(m.observe({hands(0.006)}, kBothMove, at(0ms)), SizeIs(1));
  EXPECT_THAT(m.observe({hands(0.006)}, kBothMove, at(10ms)), IsEmpty());
  EXPECT_THAT(m.observe({hands(0.009)}, kBothMove, at(20ms)), IsEmpty());
  EXPECT_THAT(m.observe({hands(0.0056)}, kBothMove, at(30ms)), IsEmpty());
}

TEST(PresentCheck, ReportsAPairAgainWhenItHasComeCloserInSmallSteps) {
  PresentCheck m;
  EXPECT_THAT(m.observe({hands(0.006)}, kBothMove, at(0ms)), SizeIs(1));
  int again = 0;
  for (int i = 1; i <= 10; ++i) {
    again += static_cast<int>(m.observe({hands(0.006 - 0.0001 * i)}, kLeftMoves, at(0ms)).size());
  }
  EXPECT_EQ(again, 1);  // when it has come 0.6 mm closer
}

TEST(PresentCheck, DoesNotRepeatAPairWhileBothArmsRest) {
  PresentCheck m;
  EXPECT_THAT(m.observe({hands(0.006)}, kBothMove, at(0ms)), SizeIs(1));
  EXPECT_THAT(m.observe({hands(0.002)}, kNoneMoves, at(10ms)), IsEmpty());
  EXPECT_THAT(m.observe({hands(0.002)}, kLeftMoves, at(20ms)), SizeIs(1));
}

TEST(PresentCheck, AllowsSeparatingArmsAfterAStop) {
  PresentCheck m;
  EXPECT_THAT(m.observe({hands(0.003)}, kBothMove, at(0ms)), SizeIs(1));
  for (int i = 1; i < 70; ++i) {
    EXPECT_THAT(m.observe({hands(0.003 + 0.0001 * i)}, kLeftMoves, at(0ms)), IsEmpty());
  }
}

TEST(PresentCheck, ReportsAPairAgainAfterItHasCleared) {
  PresentCheck m;
  EXPECT_THAT(m.observe({hands(0.006), hand_and_table(0.002)}, kBothMove, at(0ms)), SizeIs(2));
  EXPECT_THAT(m.observe({hand_and_table(0.002)}, kBothMove, at(10ms)), IsEmpty());
  EXPECT_THAT(m.observe({hands(0.006), hand_and_table(0.002)}, kBothMove, at(20ms)), SizeIs(1));
}

TEST(PresentCheck, ReportsAPairOnceThatNoiseTakesAcrossItsLimit) {
  PresentCheck m;
  EXPECT_THAT(m.observe({hands(0.0099)}, kNoneMoves, at(0ms)), SizeIs(1));
  for (Duration t = 10ms; t < 3s; t += 20ms) {
    EXPECT_THAT(m.observe({}, kNoneMoves, at(t)), IsEmpty());
    EXPECT_THAT(m.observe({hands(0.0099)}, kNoneMoves, at(t + 10ms)), IsEmpty());
  }
  EXPECT_THAT(m.observe({}, kNoneMoves, at(3s)), IsEmpty());
  EXPECT_THAT(m.observe({hands(0.0099)}, kLeftMoves, at(3010ms)), SizeIs(1)) << "it stops an arm";
  EXPECT_THAT(m.observe({}, kNoneMoves, at(4s)), IsEmpty());
  EXPECT_THAT(m.observe({}, kNoneMoves, at(5s)), IsEmpty());
  EXPECT_THAT(m.observe({hands(0.0099)}, kNoneMoves, at(5010ms)), SizeIs(1));
}

TEST(PresentCheck, RecognizesAPairInEitherOrder) {
  PresentCheck m;
  Proximity turned = hands(0.006);
  turned = turned_around(std::move(turned));
  EXPECT_THAT(m.observe({hands(0.006)}, kBothMove, at(0ms)), SizeIs(1));
  EXPECT_THAT(m.observe({turned}, kBothMove, at(10ms)), IsEmpty());
}

}  // namespace
}  // namespace armloom
