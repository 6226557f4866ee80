#include "core/monitor/premises.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "test/monitor/two_joint_arms.h"

namespace armloom {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;
using Kind = MonitorFinding::Kind;

const ArmId kArm{0};

// One arm that the test moves and measures.
struct Watched {
  CellPtr cell = two_joint_arms(1);
  PremiseCheck premises{cell};
  TrajectoryPtr curve = curve_of(kArm);
  Observation seen{.time = {}, .measured = Configuration::Zero(2), .arms = {ArmObservation{}}};

  ArmObservation& arm() { return seen.arms[0]; }
  // Starts the motion at zero.
  void start() {
    arm() = {.motion = curve, .authority = 2s, .rests = false};
    EXPECT_THAT(look(), IsEmpty());
  }
  // The arm is measured on its path at `progress`, and commanded `lag` farther.
  void on_path(Duration progress, Duration lag = 0ms) {
    arm().measured = progress;
    arm().commanded = progress + lag;
    curve->sample_positions(progress, path);
    seen.measured = path;
  }
  // Looks 10 ms later. The controller's clock is another one.
  std::vector<MonitorFinding> look() {
    seen.time += 10ms;
    arm().reported = {1, seen.time.time_since_epoch() + slipped - arm().feedback_age};
    return premises.check(seen);
  }
  // Follows the path from `from` to `to` in real time; returns all findings.
  std::vector<MonitorFinding> follow(Duration from, Duration to) {
    std::vector<MonitorFinding> all;
    for (Duration at = from; at <= to; at += 10ms) {
      on_path(at);
      for (const MonitorFinding& found : look()) all.push_back(found);
    }
    return all;
  }
  Eigen::VectorXd path;
  Duration slipped{};  // cell time that the server lost
};

TEST(Premises, AcceptAnArmOnItsPath) {
  Watched w;
  w.start();
  EXPECT_THAT(w.follow(10ms, 2s), IsEmpty());
  EXPECT_TRUE(w.premises.is_as_certified(kArm));
}

TEST(Premises, ReportJointValueAndLimitOfADeviation) {
  Watched w;
  w.start();
  ASSERT_THAT(w.follow(10ms, 500ms), IsEmpty());
  w.on_path(510ms);
  w.seen.measured[1] += 0.0015;
  const auto found = w.look();
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found[0].kind, Kind::deviation);
  EXPECT_EQ(found[0].arm, kArm);
  EXPECT_EQ(found[0].joint, JointId{1});
  EXPECT_NEAR(found[0].value, 0.0015, 1e-12);
  EXPECT_EQ(found[0].limit, kTracking);
  EXPECT_EQ(found[0].time, w.seen.time);
  EXPECT_THAT(found[0].stops, ElementsAre(kArm));
  EXPECT_NEAR(w.premises.deviation(kArm), 0.0015, 1e-12);
  EXPECT_FALSE(w.premises.is_as_certified(kArm));
  EXPECT_THAT(w.look(), IsEmpty()) << "reported once";
}

TEST(Premises, AcceptALateArm) {
  Watched w;
  w.start();
  ASSERT_THAT(w.follow(10ms, 500ms), IsEmpty());
  // Reported progress stays behind the positions, but not behind the command.
  w.on_path(515ms);
  w.arm().measured = 500ms;
  w.arm().commanded = 700ms;
  EXPECT_THAT(w.look(), IsEmpty());
}

TEST(Premises, RequireOneCommonProgressOfAllJoints) {
  Watched w;
  w.start();
  ASSERT_THAT(w.follow(10ms, 500ms), IsEmpty());
  // Each joint is on its own curve, but the first lags 20 ms behind the second.
  w.on_path(520ms);
  const double second = w.seen.measured[1];
  w.on_path(500ms, 40ms);
  w.seen.measured[1] = second;
  EXPECT_THAT(w.look(), SizeIs(1));
}

TEST(Premises, UseTheLimitOfTheRobot) {
  auto cell = std::make_shared<Cell>(*two_joint_arms(1));
  cell->robots[0].controller.tracking_error_rad = 0.01;
  Watched w;
  w.premises = PremiseCheck(cell);
  w.start();
  ASSERT_THAT(w.follow(10ms, 500ms), IsEmpty());
  w.on_path(510ms);
  w.seen.measured[0] += 0.009;
  EXPECT_THAT(w.look(), IsEmpty());
  w.seen.measured[0] += 0.002;
  EXPECT_THAT(w.look(), SizeIs(1));
}

TEST(Premises, AcceptTheDistanceForWhichAMotionWasCertified) {
  Watched w;
  w.seen.measured[0] = 0.005;
  w.arm() = {.motion = w.curve, .authority = 2s, .rests = false, .off_path = 0.005};
  EXPECT_THAT(w.look(), IsEmpty());
  w.seen.measured[0] = 0.0059;
  EXPECT_THAT(w.look(), IsEmpty()) << "one tracking error more, for noise";
  w.seen.measured[0] = 0.0061;
  EXPECT_THAT(w.look(), SizeIs(1));
}

TEST(Premises, ReportAnArmThatMovesOnAfterAStop) {
  Watched w;
  w.start();
  ASSERT_THAT(w.follow(10ms, 500ms), IsEmpty());
  w.on_path(510ms);
  w.seen.measured[0] += 0.002;
  ASSERT_THAT(w.look(), SizeIs(1));
  w.arm().rests = true;
  ASSERT_THAT(w.look(), IsEmpty());
  w.arm().rests = false;
  EXPECT_THAT(w.look(), SizeIs(1));
}

TEST(Premises, CheckJointsThatTheMotionDoesNotMove) {
  Watched w;
  Eigen::Matrix<double, Eigen::Dynamic, 6> c = Eigen::MatrixXd::Zero(1, 6);
  c(0, 1) = 0.1;
  w.arm() = {.motion = std::make_shared<Trajectory>(std::vector{JointId{0}}, std::vector{kArm},
                                                    std::vector{Segment{Duration{}, 2s, c}}),
             .authority = 2s,
             .rests = false};
  ASSERT_THAT(w.look(), IsEmpty());
  w.seen.measured[1] = 0.002;
  const auto found = w.look();
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found[0].joint, JointId{1});
}

TEST(Premises, ReportAnArmThatMovesWithoutAMotionOnce) {
  Watched w;
  ASSERT_THAT(w.look(), IsEmpty());
  w.seen.measured[1] = 0.0009;
  ASSERT_THAT(w.look(), IsEmpty());
  std::vector<MonitorFinding> all;
  for (int i = 0; i < 100; ++i) {
    w.seen.measured[1] += 0.0005;
    for (const auto& found : w.look()) all.push_back(found);
    EXPECT_FALSE(w.premises.is_as_certified(kArm));
  }
  ASSERT_THAT(all, SizeIs(1));
  EXPECT_EQ(all[0].kind, Kind::unplanned_motion);
  EXPECT_EQ(all[0].joint, JointId{1});
  EXPECT_GT(all[0].value, kTracking);
  EXPECT_THAT(all[0].stops, ElementsAre(kArm));
  // After it has stood still, another motion is a new one.
  for (int i = 0; i < 101; ++i) ASSERT_THAT(w.look(), IsEmpty());
  EXPECT_TRUE(w.premises.is_as_certified(kArm));
  w.seen.measured[1] += 0.002;
  EXPECT_THAT(w.look(), SizeIs(1));
}

TEST(Premises, CompareARestingArmWithTheGoalOfItsMotion) {
  Watched w;
  w.start();
  ASSERT_THAT(w.follow(10ms, 2s), IsEmpty());
  // Measured with an error when the motion ends, and with the opposite error later.
  w.arm() = {};
  w.seen.measured[0] += 0.0008;
  ASSERT_THAT(w.look(), IsEmpty());
  w.seen.measured[0] -= 0.0016;
  EXPECT_THAT(w.look(), IsEmpty());
  w.seen.measured[0] -= 0.0004;
  EXPECT_THAT(w.look(), SizeIs(1));
}

TEST(Premises, ReportProgressBeyondAuthority) {
  Watched w;
  w.start();
  w.arm().authority = 5ms;
  w.on_path(10ms);
  const auto found = w.look();
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found[0].kind, Kind::beyond_authority);
  EXPECT_EQ(found[0].value, 0.01);
  EXPECT_EQ(found[0].limit, 0.005);
  EXPECT_FALSE(w.premises.keeps_authority(kArm));
}

// Joint 0 moves at 1 rad/s and brakes with 10 rad/s^2, in 50 ms of the motion.
TEST(Premises, ReportAnArmThatCannotComeToRestAtItsAuthority) {
  Watched w;
  w.start();
  w.arm().authority = 500ms;
  ASSERT_THAT(w.follow(10ms, 450ms), IsEmpty());
  const auto found = w.follow(460ms, 470ms);
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found[0].kind, Kind::beyond_authority);
  EXPECT_GT(found[0].value, 0.501);
  EXPECT_LT(found[0].value, 0.521);
  EXPECT_FALSE(w.premises.is_as_certified(kArm));
}

TEST(Premises, AcceptTheHardestBrakeToTheAuthority) {
  Watched w;
  w.start();
  w.arm().authority = 500ms;
  ASSERT_THAT(w.follow(10ms, 450ms), IsEmpty());
  for (int tick = 1; tick <= 10; ++tick) {
    const double left_s = 0.1 - 0.01 * tick;
    w.on_path(500ms - from_seconds(5.0 * left_s * left_s));
    EXPECT_THAT(w.look(), IsEmpty()) << tick;
  }
}

// At half the planned rate the arm brakes in 12.5 ms of the motion.
TEST(Premises, TakeTheRateFromTheTimesOfTheReports) {
  Watched w;
  w.start();
  w.arm().authority = 500ms;
  for (Duration at = 5ms; at <= 470ms; at += 5ms) {
    w.on_path(at);
    ASSERT_THAT(w.look(), IsEmpty());
  }
  w.arm().feedback_age = 10ms;
  ASSERT_THAT(w.look(), IsEmpty());
  w.arm().feedback_age = 0ms;
  w.on_path(480ms);  // 20 ms after the last report
  EXPECT_THAT(w.look(), IsEmpty());
}

// The arm brakes as hard as it may in 50 ms of real time, which the server takes for 10 ms.
TEST(Premises, TakeTheRateFromTheClockOfTheController) {
  Watched w;
  w.start();
  w.arm().authority = 500ms;
  ASSERT_THAT(w.follow(10ms, 450ms), IsEmpty());
  w.slipped = 40ms;
  w.on_path(487500us);
  EXPECT_THAT(w.look(), IsEmpty());
  w.slipped = 90ms;
  w.on_path(500ms);
  EXPECT_THAT(w.look(), IsEmpty());
}

TEST(Premises, ReportAnArmThatIgnoresItsStop) {
  Watched w;
  w.start();
  ASSERT_THAT(w.follow(10ms, 200ms), IsEmpty());
  w.arm().told_to_brake = w.seen.time;
  Duration progress = 200ms;
  std::vector<MonitorFinding> found;
  while (found.empty() && progress < 1990ms) {
    w.on_path(progress += 10ms);
    found = w.look();
  }
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found[0].kind, Kind::stop_ignored);
  EXPECT_GT(found[0].value, found[0].limit);
  EXPECT_LT(found[0].value, found[0].limit + 0.02);
  EXPECT_GT(found[0].limit, 0.4) << "it has time to brake and to settle";
}

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

TEST(Premises, AcceptAnArmThatWaitsOnItsPath) {
  Watched w;
  w.start();
  ASSERT_THAT(w.follow(10ms, 500ms), IsEmpty());
  for (int i = 0; i < 100; ++i) EXPECT_THAT(w.look(), IsEmpty());
}

TEST(Premises, ReportAMotionThatFinishedAwayFromItsGoal) {
  Watched w;
  w.start();
  w.on_path(2s);
  EXPECT_FALSE(w.premises.finished(kArm, *w.curve, w.seen.measured, at(2s)));
  w.on_path(1900ms);
  const auto found = w.premises.finished(kArm, *w.curve, w.seen.measured, at(2s));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->kind, Kind::early_finish);
  EXPECT_EQ(found->joint, JointId{0});
  EXPECT_NEAR(found->value, 0.1, 1e-9);
}

TEST(DistanceFromPath, FindsTheNearestCommonPoint) {
  const TrajectoryPtr curve = curve_of(kArm);
  const std::vector<JointId> joints{JointId{0}, JointId{1}};
  for (const Duration at : std::vector<Duration>{3ms, 117ms, 1234567us, 1999ms}) {
    Eigen::VectorXd q;
    curve->sample_positions(at, q);
    const PathDistance far = distance_from_path(*curve, joints, 0ms, 2s, q, 0.0);
    EXPECT_LT(far.distance, 1e-4) << to_seconds(at);
    EXPECT_NEAR(to_seconds(far.progress), to_seconds(at), 1e-4);
  }
  Eigen::VectorXd q;
  curve->sample_positions(1s, q);
  q[0] += 0.01;
  q[1] -= 0.01;  // the velocity there is (1, 0): the distance is at least that of the second joint
  EXPECT_NEAR(distance_from_path(*curve, joints, 0ms, 2s, q, 0.0).distance, 0.01, 3e-4);
}

}  // namespace
}  // namespace armloom
