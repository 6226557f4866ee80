#include <gtest/gtest.h>

#include "test/arm/started_arm.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;
using Phase = ArmFeedback::Phase;

double any_share(std::mt19937_64& random) {
  return std::vector{0.0, 0.001, 0.1, 0.25, 0.5, 0.9, 1.0}[random() % 7];
}

TEST(SpeedOverrideOfArm, RateChangesWithinTheJointLimitsAndAuthorityIsKept) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    SCOPED_TRACE(seed);
    Example e({.brake_per_acceleration = seed % 3 == 0 ? 1.0 : 2.0}, seed);
    AccelerationGauge gauge(*e.cell, e.trajectory);
    const Duration duration = e.trajectory->duration();
    Duration authority = duration / 3;
    e.bench.command.set_speed(any_share(e.random));
    e.bench.command.start(e.trajectory, at(0ms), {}, authority);
    for (int i = 0; i < 20'000; ++i) {
      if (e.random() % 150 == 0) e.bench.command.set_speed(any_share(e.random));
      if (e.random() % 300 == 0) {
        authority = std::min(authority + duration / 20, duration);
        e.bench.command.grant(authority);
      }
      const ArmFeedback& feedback = e.bench.tick();
      ASSERT_LE(feedback.commanded_progress, authority);
      gauge.observe(feedback, true);
    }
    e.bench.command.grant(duration);
    e.bench.command.set_speed(1.0);
    for (Phase phase = Phase::moving; phase != Phase::finished;) {
      const ArmFeedback& feedback = e.bench.tick();
      phase = feedback.phase;
      gauge.observe(feedback, true);
    }
    EXPECT_LE(gauge.worst_share(), 1.0 + e.cell->checking.limit_tolerance);
  }
}

// Returns where the arm rests after a brake in full motion.
Duration stopped_with(double brake, std::uint64_t seed) {
  Example e({}, seed);
  AccelerationGauge gauge(*e.cell, e.trajectory);
  e.bench.command.set_speed(std::sqrt(brake), brake);
  e.start_now();
  const Duration half = e.trajectory->duration() / 2;
  const auto tick = [&] {
    gauge.observe(e.bench.tick(), true, brake);
    return e.bench.arm.state();
  };
  while (tick().commanded_progress < half) continue;
  e.bench.command.brake();
  while (tick().phase != Phase::stopped) continue;
  EXPECT_LE(gauge.worst_share(), 1.0 + e.cell->checking.limit_tolerance);
  return e.bench.arm.state().commanded_progress;
}

TEST(Payload, TheArmKeepsWhatIsLeftOfItsLimitsAndStopsWhereItDoesWithEmptyHands) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    const double empty_s = to_seconds(stopped_with(1.0, seed));
    EXPECT_NEAR(to_seconds(stopped_with(0.25, seed)), empty_s, 2e-3);
  }
}

TEST(SpeedOverrideOfArm, MotionAtATenthTakesTenTimesAsLong) {
  Example e;
  e.bench.command.set_speed(0.1);
  e.start_now();
  e.bench.tick_until(Phase::finished);
  const double planned_s = to_seconds(e.trajectory->duration());
  EXPECT_NEAR(to_seconds(e.bench.now), 10 * planned_s, 0.3);
}

TEST(SpeedOverrideOfArm, AtZeroTheArmRestsOnItsPathAndContinuesWhenRaised) {
  Example e;
  e.start_now();
  e.bench.tick_for(700ms);
  e.bench.command.set_speed(0.0);
  const ArmFeedback& feedback = e.bench.tick_for(2s);
  EXPECT_EQ(feedback.phase, Phase::moving);
  EXPECT_TRUE(feedback.settled);
  EXPECT_EQ(feedback.measured_progress, feedback.commanded_progress);
  const Duration rests_at = feedback.commanded_progress;
  EXPECT_GT(rests_at, 700ms);
  EXPECT_LT(e.off_path(feedback, rests_at), 1e-9);
  EXPECT_EQ(e.bench.tick_for(1s).commanded_progress, rests_at);
  e.bench.command.set_speed(0.5);
  e.bench.tick_until(Phase::finished);
}

TEST(SpeedOverrideOfArm, StartAtZeroWaitsAtTheStartOfThePath) {
  Example e;
  e.bench.command.set_speed(0.0);
  e.start_now();
  EXPECT_EQ(e.bench.tick_for(1s).commanded_progress, 0ms);
  e.bench.command.set_speed(0.25);
  EXPECT_EQ(e.bench.tick_for(100ms).commanded_progress, 25ms);
}

TEST(SpeedOverrideOfArm, BrakeWorksAtAnyOverride) {
  for (const double share : {0.0, 0.1, 0.7}) {
    Example e;
    e.start_now();
    e.bench.tick_for(800ms);
    e.bench.command.set_speed(share);
    e.bench.tick_for(20ms);
    e.bench.command.brake();
    EXPECT_EQ(e.bench.tick_until(Phase::stopped, 2s).phase, Phase::stopped) << share;
  }
}

TEST(SpeedOverrideOfArm, ArmsOfOneMotionStayInStep) {
  std::mt19937_64 random(7);
  const CellPtr cell = two_arm_cell();
  std::vector<JointId> joints = joints_of(*cell, kLeft);
  for (const JointId joint : joints_of(*cell, kRight)) joints.push_back(joint);
  const TrajectoryPtr both = random_trajectory(*cell, joints, {kLeft, kRight}, random);
  Bench left(cell, kLeft, *both);
  Bench right(cell, kRight, *both);
  for (Bench* bench : {&left, &right}) bench->command.start(both, at(0ms), {}, both->duration());
  for (int i = 0; i < 10'000; ++i) {
    const double share = any_share(random);
    for (Bench* bench : {&left, &right}) {
      if (i % 170 == 0) bench->command.set_speed(share);
    }
    ASSERT_EQ(left.tick().commanded_progress, right.tick().commanded_progress) << i;
  }
}

}  // namespace
}  // namespace armloom
