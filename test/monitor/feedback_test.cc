// The premises about feedback: it is new, and the arm can have moved so.
#include "test/monitor/watched_arm.h"

namespace armloom {
namespace {

using testing::IsEmpty;
using testing::SizeIs;
using Kind = MonitorFinding::Kind;

TEST(Premises, ReportLateFeedbackOnce) {
  Watched w;
  w.start();
  w.arm().feedback_age = kTimeout;
  EXPECT_THAT(w.look(), IsEmpty());
  w.arm().feedback_age = kTimeout + 1ms;
  const auto found = w.look();
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found[0].kind, Kind::late_feedback);
  EXPECT_EQ(found[0].value, 0.101);
  EXPECT_EQ(found[0].limit, 0.1);
  w.arm().feedback_age += 10ms;
  EXPECT_THAT(w.look(), IsEmpty());
}

TEST(Premises, AcceptTheJumpAfterMissingFeedback) {
  Watched w;
  w.start();
  ASSERT_THAT(w.follow(10ms, 500ms), IsEmpty());
  for (int i = 1; i <= 9; ++i) {  // no report for 90 ms
    w.arm().feedback_age = i * 10ms;
    ASSERT_THAT(w.look(), IsEmpty());
  }
  w.arm().feedback_age = 0ms;
  w.on_path(600ms);
  EXPECT_THAT(w.look(), IsEmpty());
}

TEST(Premises, ReportPositionsThatChangeTooFast) {
  Watched w;
  w.start();
  ASSERT_THAT(w.follow(10ms, 500ms), IsEmpty());
  w.on_path(550ms);  // 0.05 rad in 10 ms
  const auto found = w.look();
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found[0].kind, Kind::implausible_feedback);
  EXPECT_NEAR(found[0].value, 0.05, 1e-9);
  EXPECT_LT(found[0].limit, 0.03);
}

TEST(Premises, AcceptReportsThatABusyServerTakesAtOnce) {
  Watched w;
  w.start();
  ASSERT_THAT(w.follow(10ms, 500ms), IsEmpty());
  w.slipped = 40ms;
  w.on_path(550ms);
  EXPECT_THAT(w.look(), IsEmpty()) << "50 ms by the controller's clock";
  EXPECT_NEAR(w.premises.velocity()[0], 1.0, 1e-9);
  w.on_path(600ms);
  EXPECT_THAT(w.look(), SizeIs(1));
}

TEST(Premises, KeepTheVelocityUntilTheNextReport) {
  Watched w;
  w.start();
  ASSERT_THAT(w.follow(10ms, 500ms), IsEmpty());
  w.arm().feedback_age = 10ms;
  ASSERT_THAT(w.look(), IsEmpty());
  EXPECT_NEAR(w.premises.velocity()[0], 1.0, 1e-9);
}

// A controller that was restarted begins its clock again.
TEST(Premises, DoNotCompareReportsOfTwoConnections) {
  Watched w;
  w.start();
  ASSERT_THAT(w.follow(10ms, 500ms), IsEmpty());
  w.seen.time += 10ms;
  w.on_path(560ms);
  w.arm().reported.connection = 2;
  w.arm().reported.at += 1ms;
  EXPECT_THAT(w.premises.check(w.seen), IsEmpty());
}

TEST(Premises, ReportFrozenPositions) {
  Watched w;
  w.start();
  ASSERT_THAT(w.follow(10ms, 500ms), IsEmpty());
  std::vector<MonitorFinding> all;
  for (int i = 1; i <= 20; ++i) {
    w.arm().commanded += 10ms;
    for (const auto& found : w.look()) all.push_back(found);
    if (i == 10) {
      ASSERT_THAT(all, IsEmpty());
    }
  }
  ASSERT_THAT(all, SizeIs(1));
  EXPECT_EQ(all[0].kind, Kind::frozen_feedback);
  EXPECT_NEAR(all[0].value, 0.11, 1e-9);
}

TEST(Premises, ReportFrozenPositionsAgainAfterAResume) {
  Watched w;
  w.start();
  ASSERT_THAT(w.follow(10ms, 500ms), IsEmpty());
  const auto freeze = [&w] {
    std::size_t count = 0;
    for (int i = 1; i <= 20; ++i) {
      w.arm().commanded += 10ms;
      count += w.look().size();
    }
    return count;
  };
  ASSERT_EQ(freeze(), 1u);
  ASSERT_EQ(freeze(), 0u);
  w.premises.resumed(kArm);
  EXPECT_EQ(freeze(), 1u);
}

TEST(Premises, ReportPositionsAgainThatJumpAfterAResume) {
  Watched w;
  ASSERT_THAT(w.look(), IsEmpty());
  const auto jump = [&w] {
    std::size_t count = 0;
    for (int i = 0; i < 20; ++i) {
      w.seen.measured[0] = i % 2 == 0 ? 0.05 : -0.05;
      for (const MonitorFinding& one : w.look()) count += one.kind == Kind::implausible_feedback;
    }
    return count;
  };
  ASSERT_EQ(jump(), 1u);
  w.premises.resumed(kArm);
  EXPECT_EQ(jump(), 1u);
}

TEST(Premises, AcceptAnArmThatWaitsOnItsPath) {
  Watched w;
  w.start();
  ASSERT_THAT(w.follow(10ms, 500ms), IsEmpty());
  for (int i = 0; i < 100; ++i) EXPECT_THAT(w.look(), IsEmpty());
}

TEST(Premises, IgnoreAnArmUntilItsControllerHasConnected) {
  Watched w;
  w.arm().is_connected = false;
  w.arm().feedback_age = Duration::max();
  EXPECT_THAT(w.look(), IsEmpty());
  w.arm() = {};
  w.seen.measured[0] = 1.0;  // not at home
  EXPECT_THAT(w.look(), IsEmpty());
  w.seen.measured[0] += 0.002;
  EXPECT_THAT(w.look(), SizeIs(1));
}

}  // namespace
}  // namespace armloom
