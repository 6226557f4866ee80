#include "core/monitor/look_ahead.h"

#include "core/model/promises.h"
#include "test/monitor/arms_on_a_line.h"

namespace armloom {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

TEST(LookAhead, AsksNothingAboutCertifiedPairs) {
  Ahead a(2);
  a.certificates.all = true;
  a.on_path(0, 500ms);
  a.on_path(1, 500ms);
  EXPECT_THAT(a.look(), IsEmpty());
  EXPECT_EQ(a.line.asked, 0);
}

TEST(LookAhead, AsksNothingAboutArmsAtRest) {
  Ahead a(3);
  EXPECT_THAT(a.look(), IsEmpty());
  EXPECT_EQ(a.line.asked, 0);
}

// Drives an arm towards an arm at rest. Returns where it rests if it is stopped when the monitor
// says so.
TEST(LookAhead, StopsAnArmWhenTheNextPeriodWouldBeTooLate) {
  Ahead a(2);
  a.line.bases = {0.0, 1.5};
  Duration progress = 500ms;
  std::vector<MonitorFinding> found;
  while (found.empty() && progress < 2s) {
    a.on_path(0, progress += kPeriod);
    found = a.look();
  }
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found[0].kind, MonitorFinding::Kind::approach);
  EXPECT_EQ(found[0].limit_m, 0.01);
  EXPECT_THAT(found[0].stops, ElementsAre(ArmId{0}));
  const auto reach = a.ahead.reach_of(ArmId{0}, a.seen, a.premises, true);
  EXPECT_LT(to_seconds(reach.braking.to), 1.49) << "it rests in time";
  EXPECT_GT(to_seconds(reach.braking.to) + to_seconds(kPeriod), 1.49) << "and not too early";
}

// The brake of an arm with a payload is weaker. The rate at which the arm goes makes up for it.
TEST(LookAhead, ExpectsALongerWayOfAnArmWithAPayload) {
  Ahead empty(1), half(1), loaded(1);
  for (Ahead* ahead : {&empty, &half, &loaded}) {
    const bool is_slow = ahead != &empty;
    ahead->seen.arms[0].brake = ahead == &loaded ? 0.25 : 1.0;
    for (int i = 0; i < 3; ++i) {
      ahead->on_path(0, 500ms + (i - 2) * (is_slow ? kPeriod / 2 : kPeriod));
      (void)ahead->look();
    }
  }
  const auto way = [](Ahead& ahead) {
    return to_seconds(ahead.ahead.reach_of(ArmId{0}, ahead.seen, ahead.premises, true).braking.to);
  };
  EXPECT_LT(way(half), way(loaded) - 0.02);
  EXPECT_LE(way(loaded), way(empty));
}

TEST(LookAhead, StopsOneOfTwoArmsIfThatIsEnough) {
  Ahead a(2);
  // Both reaches overlap only in their last 5 ms.
  a.line.signs = {1.0, -1.0};
  a.on_path(0, 500ms);
  a.on_path(1, 500ms);
  const Duration going = a.goes_to(ArmId{0});
  a.line.bases = {0.0, 2 * to_seconds(going) + 0.01 - 0.005};
  const auto found = a.look();
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_THAT(found[0].stops, ElementsAre(ArmId{0}));
}

TEST(LookAhead, StopsBothArmsIfOneIsNotEnough) {
  Ahead a(2);
  a.line.signs = {1.0, -1.0};
  a.on_path(0, 500ms);
  a.on_path(1, 500ms);
  const Duration going = a.goes_to(ArmId{0});
  a.line.bases = {0.0, 2 * to_seconds(going) + 0.01 - 0.015};
  EXPECT_THAT(a.look().at(0).stops, ElementsAre(ArmId{0}, ArmId{1}));
}

TEST(LookAhead, StopsTheArmBetweenTwoOthersOnly) {
  Ahead a(3);
  a.line.signs = {1.0, 1.0, 1.0};
  for (std::uint32_t arm : {0U, 1U, 2U}) a.on_path(arm, 500ms);
  // Arm 2 follows close behind arm 0 and arm 1, which are at the same place but ask for nothing:
  // stopping either of them does not help the other.
  const Duration going = a.goes_to(ArmId{2});
  const double reach_m = to_seconds(going) - 0.5;
  a.line.bases = {reach_m + 0.01 - 0.005, -10.0, 0.0};
  const auto found = a.look();
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_THAT(found[0].stops, ElementsAre(ArmId{2})) << "the leader's stop would not help";
}

TEST(LookAhead, NeverLooksBeyondTheAuthority) {
  Ahead a(2);
  a.line.bases = {0.0, 0.53};
  a.on_path(0, 500ms);
  a.seen.arms[0].authority = 510ms;
  EXPECT_THAT(a.look(), IsEmpty());
  a.seen.arms[0].authority = 525ms;
  EXPECT_THAT(a.look(), SizeIs(1));
}

// A monitor period in which 4 ms of the motion were reported, and one without a report.
TEST(LookAhead, TakesTheRateFromTheTimesOfTheReports) {
  Ahead a(1);
  a.on_path(0, 500ms);
  a.look();
  a.on_path(0, 510ms);
  a.look();
  const auto ahead = [&] { return a.goes_to(ArmId{0}) - a.seen.arms[0].commanded; };
  const Duration as_planned = ahead();
  a.reported_after = 4ms;
  a.on_path(0, 514ms);
  a.look();
  EXPECT_EQ(ahead(), as_planned);
  a.reported_after = 0ms;
  a.look();
  EXPECT_EQ(ahead(), as_planned);
}

TEST(LookAhead, AssumesAnyRateIfAReportIsOverdue) {
  Ahead a(1);
  a.on_path(0, 500ms);
  a.look();
  a.on_path(0, 505ms);
  a.look();
  const Duration at_half_the_rate = a.goes_to(ArmId{0});
  a.reported_after = 0ms;
  a.seen.arms[0].feedback_age = 10ms;
  a.look();
  EXPECT_GT(a.goes_to(ArmId{0}), at_half_the_rate);
}

TEST(LookAhead, StopsAnArmThatApproachesTheScene) {
  Ahead a(1);
  a.line.wall = 0.585;
  a.on_path(0, 500ms);
  const auto found = a.look();
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found[0].proximity.body_b, "wall");
  EXPECT_THAT(found[0].stops, ElementsAre(ArmId{0}));
}

TEST(LookAhead, ReportsAConflictOnceIfNoStopHelps) {
  Ahead a(2);
  a.line.bases = {0.0, 0.55};
  a.on_path(0, 500ms);
  a.seen.arms[0].brakes = true;
  const auto found = a.look();
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_THAT(found[0].stops, IsEmpty());
  EXPECT_THAT(a.look(), IsEmpty());
}

// Noise makes a pair appear and disappear.
TEST(LookAhead, ReportsAConflictAgainIfItWasNotPredictedForASecond) {
  Ahead a(2);
  a.on_path(0, 500ms);
  a.seen.arms[0].brakes = true;
  std::size_t count = 0;
  for (int i = 0; i < 300; ++i) {
    a.line.bases[1] = i % 3 == 0 ? 0.55 : 5.0;
    count += a.look().size();
  }
  EXPECT_EQ(count, 1u);
  a.line.bases[1] = 5.0;
  for (int i = 0; i < 100; ++i) ASSERT_THAT(a.look(), IsEmpty());
  a.line.bases[1] = 0.55;
  EXPECT_THAT(a.look(), SizeIs(1));
}

TEST(LookAhead, TrustsTheRestOfABrakingArm) {
  Ahead a(2);
  a.line.bases = {0.0, 0.55};
  a.on_path(0, 500ms);
  a.seen.arms[0].brakes = true;
  a.seen.arms[0].rests_at = 530ms;
  EXPECT_THAT(a.look(), IsEmpty());
}

// Joint 0 leaves the path at 0.2 rad/s. With 20 ms reaction and a brake of 10 rad/s^2 it goes
// 0.2 * 0.02 + 0.2^2 / 20 = 0.006 rad farther.
TEST(LookAhead, ExtrapolatesAnArmThatLeftItsPath) {
  Ahead a(1);
  a.certificates.all = true;
  a.on_path(0, 500ms);
  ASSERT_THAT(a.look(), IsEmpty());
  for (int i = 1; i <= 3; ++i) {
    a.on_path(0, 500ms + i * kPeriod);
    a.seen.measured[0] -= 0.002 * i;  // behind the path, whose second joint does not fit
    ASSERT_THAT(a.look(), IsEmpty());
  }
  const Reach reach = a.ahead.reach_of(ArmId{0}, a.seen, a.premises, true).braking;
  EXPECT_NEAR(reach.shift[0] - reach.error[0], -0.012, 1e-9);
  EXPECT_NEAR(reach.shift[0] + reach.error[0], -0.006, 1e-9);
  EXPECT_EQ(reach.error[1], 0.0);
}

// The arm cannot come to rest at its authority any more.
TEST(LookAhead, LooksBeyondAnAuthorityThatIsNotKept) {
  Ahead a(2);
  a.line.bases = {0.0, 0.55};
  for (const Duration progress : {500ms, 510ms}) {
    EXPECT_THAT(a.look(), IsEmpty());
    a.on_path(0, progress);
    a.seen.arms[0].authority = 515ms;
  }
  a.certificates.all = true;  // up to the authority
  EXPECT_THAT(a.look(), SizeIs(1));
}

TEST(LookAhead, AddsTwiceTheDelayOfLateReports) {
  Ahead a(1);
  a.on_path(0, 500ms);
  const Duration promised = promises_of(a.cell->robots[0].controller).until_told();
  a.seen.arms[0].feedback_age = promised;
  const Duration in_time = a.goes_to(ArmId{0});
  a.seen.arms[0].feedback_age = promised + 30ms;
  EXPECT_EQ(a.goes_to(ArmId{0}) - in_time, 60ms);
}

TEST(LookAhead, AssumesAnArmWithoutReportsAtItsAuthority) {
  Ahead a(2);
  a.line.bases = {0.0, 1.0};
  a.on_path(0, 500ms);
  EXPECT_THAT(a.look(), IsEmpty());
  a.seen.arms[0].feedback_age = kTimeout + 1ms;
  a.seen.arms[0].authority = 980ms;
  EXPECT_THAT(a.look(), IsEmpty());
  a.seen.arms[0].authority = 1s;
  EXPECT_THAT(a.look(), SizeIs(1));
}

TEST(LookAhead, CountsAnArmThatIsStoppedInThisPeriodAsBraking) {
  Ahead a(2);
  a.line.signs = {1.0, -1.0};
  a.on_path(0, 500ms);
  a.on_path(1, 500ms);
  const Duration going = a.goes_to(ArmId{0});
  a.line.bases = {0.0, 2 * to_seconds(going) + 0.01 - 0.005};
  const auto look = [&](bool is_stopping) {
    return a.ahead.check(a.seen, a.premises, {is_stopping, false}, a.certificates, a.line);
  };
  EXPECT_THAT(look(true), IsEmpty());
  EXPECT_THAT(look(false), SizeIs(1));
}

TEST(LookAhead, ExpectsAnArmToFallBehindByItsLag) {
  auto cell = std::make_shared<Cell>(*two_joint_arms(1));
  cell->robots[0].controller.lag = 50ms;
  Ahead a(1);
  a.premises = PremiseCheck(cell);
  a.ahead = LookAhead(cell, kPeriod);
  Duration commanded = 400ms;
  const auto late_with = [&](Duration behind) {
    a.on_path(0, (commanded += kPeriod) - behind);
    a.seen.arms[0].commanded = commanded;
    EXPECT_THAT(a.look(), IsEmpty());
    return to_seconds(a.ahead.reach_of(ArmId{0}, a.seen, a.premises, false).going.late);
  };
  EXPECT_EQ(late_with(10ms), 0.0) << "its rate is not known yet";
  EXPECT_NEAR(late_with(15ms), 0.035, 1e-6);
  EXPECT_NEAR(late_with(20ms), 0.03, 1e-6);
}

TEST(LookAhead, KeepsAnArmInReachThatMovesWithoutAMotion) {
  Ahead a(2);
  a.line.bases = {0.0, 0.05};
  ASSERT_THAT(a.look(), IsEmpty());
  a.seen.measured[0] += 0.01;  // 1 rad/s: 0.02 + 0.05 rad until it rests
  const auto reach = [&] { return a.ahead.reach_of(ArmId{0}, a.seen, a.premises, true).going; };
  const auto found = a.look();
  ASSERT_THAT(found, SizeIs(1)) << "it may reach the other arm";
  EXPECT_THAT(found[0].stops, IsEmpty()) << "both rest: no stop helps";
  EXPECT_NEAR(reach().shift[0] + reach().error[0], 0.07, 1e-9);
  EXPECT_NEAR(reach().shift[0] - reach().error[0], 0.0, 1e-9);
}

TEST(LookAhead, AssumesNoSpeedBeyondTheLimitOfAJoint) {
  Ahead a(1);
  ASSERT_THAT(a.look(), IsEmpty());
  a.seen.measured[0] += 0.5;  // 50 rad/s
  ASSERT_THAT(a.look(), IsEmpty());
  const double speed = 1.05 * kVelocityMax;  // checking.limit_tolerance
  const Reach reach = a.ahead.reach_of(ArmId{0}, a.seen, a.premises, true).going;
  EXPECT_NEAR(2.0 * reach.error[0], speed * 0.02 + speed * speed / (2.0 * kBrake), 1e-9);
}

}  // namespace
}  // namespace armloom
