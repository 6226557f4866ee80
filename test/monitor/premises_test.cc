#include <set>

#include "test/monitor/watched_arm.h"

namespace armloom {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;
using Kind = MonitorFinding::Kind;

std::set<Kind> kinds(const std::vector<MonitorFinding>& findings) {
  std::set<Kind> result;
  for (const MonitorFinding& one : findings) result.insert(one.kind);
  return result;
}

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

TEST(Premises, ReportADeviationAgainAfterARestBetweenTwoPeriods) {
  Watched w;
  w.start();
  w.on_path(10ms);
  w.seen.measured[1] += 0.0015;
  ASSERT_THAT(w.look(), SizeIs(1));
  ASSERT_THAT(w.look(), IsEmpty());
  ++w.arm().starts;
  EXPECT_THAT(w.look(), SizeIs(1)) << "it does not stay without a stop";
}

TEST(Premises, ReportADeviationOnceThatComesAndGoes) {
  Watched w;
  w.start();
  std::size_t count = 0;
  for (Duration at = 10ms; at < 600ms; at += 10ms) {
    w.on_path(at);
    if (at / 10ms % 3 == 0) w.seen.measured[1] += 0.0015;
    count += w.look().size();
  }
  EXPECT_EQ(count, 1u);
  EXPECT_THAT(w.follow(600ms, 1600ms), IsEmpty());
  w.on_path(1610ms);
  w.seen.measured[1] += 0.0015;
  EXPECT_THAT(w.look(), SizeIs(1)) << "it was on its path for a second";
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
  for (int i = 0; i < 50; ++i) ASSERT_THAT(w.look(), IsEmpty());
  EXPECT_TRUE(w.premises.is_as_certified(kArm));
  for (int i = 0; i < 50; ++i) ASSERT_THAT(w.look(), IsEmpty());
  w.seen.measured[1] += 0.002;
  EXPECT_THAT(w.look(), SizeIs(1));
}

TEST(Premises, ReportAnArmAgainThatCreepsOnAfterAResume) {
  Watched w;
  ASSERT_THAT(w.look(), IsEmpty());
  const auto creep = [&w] {
    std::vector<MonitorFinding> all;
    for (int i = 0; i < 100; ++i) {
      w.seen.measured[1] += 0.0002;
      for (const auto& found : w.look()) all.push_back(found);
    }
    return all;
  };
  ASSERT_THAT(creep(), SizeIs(1));
  w.premises.resumed(kArm);
  const auto found = creep();
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found[0].kind, Kind::unplanned_motion);
  EXPECT_LT(found[0].value, 0.0013) << "as soon as it has moved on by its limit";
  EXPECT_THAT(found[0].stops, ElementsAre(kArm));
}

// It stands where it was moved to, and the scheduler must learn this.
TEST(Premises, KnowAfterAResumeThatAnArmRestsElsewhere) {
  Watched w;
  ASSERT_THAT(w.look(), IsEmpty());
  w.seen.measured[1] = 0.005;
  ASSERT_THAT(w.look(), SizeIs(1));
  w.premises.resumed(kArm);
  EXPECT_THAT(w.look(), IsEmpty());
  EXPECT_TRUE(w.premises.rests_elsewhere(kArm));
}

TEST(Premises, ReportEachViolationAgainAfterAResume) {
  Watched w;
  w.start();
  ASSERT_THAT(w.follow(10ms, 500ms), IsEmpty());
  const auto violate = [&w] {
    w.on_path(w.arm().measured + 10ms);
    w.seen.measured[0] += 0.005;
    w.arm().authority = 400ms;
    w.arm().braking_since = at(0ms);
    return kinds(w.look());
  };
  w.seen.time += 1s;  // long after the brake
  const std::set<Kind> all{Kind::deviation, Kind::beyond_authority, Kind::stop_ignored};
  EXPECT_EQ(violate(), all);
  EXPECT_THAT(violate(), IsEmpty());
  w.premises.resumed(kArm);
  EXPECT_EQ(violate(), all);
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

// It waits at its authority, and its controller still calls it moving.
TEST(Premises, DoNotTakeAnArmAtRestForOneThatIgnoresItsStop) {
  Watched w;
  w.start();
  ASSERT_THAT(w.follow(10ms, 200ms), IsEmpty());
  w.arm().braking_since = w.seen.time;
  w.arm().authority = 200ms;
  for (int i = 0; i < 300; ++i) ASSERT_THAT(w.look(), IsEmpty()) << i;
}

TEST(Premises, ReportAnArmThatIgnoresItsStop) {
  Watched w;
  w.start();
  ASSERT_THAT(w.follow(10ms, 200ms), IsEmpty());
  w.arm().braking_since = w.seen.time;
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

// It stays at its authority, but drifts off its path (found by the fault campaign, seed 9035).
TEST(Premises, ReportAnArmThatDriftsOffItsPathAfterAStop) {
  Watched w;
  w.start();
  ASSERT_THAT(w.follow(10ms, 200ms), IsEmpty());
  w.arm().braking_since = w.seen.time;
  w.arm().authority = 200ms;
  std::vector<MonitorFinding> ignored;
  for (int i = 0; i < 400; ++i) {
    w.seen.measured[1] += 0.0002;
    for (const MonitorFinding& one : w.look()) {
      if (one.kind == Kind::stop_ignored) ignored.push_back(one);
    }
  }
  ASSERT_THAT(ignored, SizeIs(1));
  EXPECT_LT(ignored[0].value, ignored[0].limit + 1.7);
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

}  // namespace
}  // namespace armloom
