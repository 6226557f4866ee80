#include <gtest/gtest.h>

#include <cmath>

#include "test/arm/started_arm.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;
using Phase = ArmFeedback::Phase;

TEST(SimulatedArm, BrakesWithinTheLimitsAndRestsOnItsPath) {
  for (const double brake : {1.0, 2.0, 4.0}) {
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
      Example e({.brake_per_acceleration = brake}, seed);
      AccelerationGauge gauge(*e.cell, e.trajectory);
      e.start_now();
      const auto ticks = e.trajectory->duration() / kControlPeriod;
      for (auto until = static_cast<Duration::rep>(e.random() % static_cast<std::uint64_t>(ticks));
           until > 0; --until) {
        gauge.observe(e.bench.tick(), false);
      }
      e.bench.command.brake();
      Duration last{};
      int braking = 0;
      while (true) {
        const ArmFeedback& feedback = e.bench.tick();
        gauge.observe(feedback, true);
        ASSERT_GE(feedback.commanded_progress, last) << seed;
        ASSERT_LT(e.off_path(feedback, feedback.measured_progress), 1e-12) << seed;
        last = feedback.commanded_progress;
        if (feedback.phase != Phase::braking) break;
        ASSERT_LT(++braking, 20'000) << seed;
      }
      const ArmFeedback& rest = e.bench.tick();
      EXPECT_TRUE(rest.phase == Phase::stopped ||
                  (rest.phase == Phase::finished && last == e.trajectory->duration()))
          << seed;
      EXPECT_EQ(rest.measured_progress, rest.commanded_progress) << seed;
      EXPECT_EQ(rest.commanded_progress, last) << seed;
      EXPECT_LE(gauge.worst_share(), 1.0 + e.cell->checking.limit_tolerance)
          << "seed " << seed << " brake " << brake;
    }
  }
}

TEST(SimulatedArm, BrakesInLessThanASecond) {
  Duration longest{};
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    Example e({}, seed);
    e.start_now();
    e.bench.tick_for(e.trajectory->duration() * static_cast<int>(1 + seed % 9) / 10);
    const TimePoint asked = e.bench.now;
    e.bench.command.brake();
    while (e.bench.tick().phase == Phase::braking) {
    }
    longest = std::max(longest, e.bench.now - asked);
  }
  // Braking from 2.61 rad/s with (7.5 - 3.75) rad/s^2 takes 0.7 s, plus the lag.
  EXPECT_LT(longest, 900ms);
  EXPECT_GT(longest, 100ms);
}

TEST(SimulatedArm, ContinuesToItsGoalAfterABrake) {
  Example e;
  e.start_now();
  e.bench.tick_for(600ms);
  e.bench.command.brake();
  const Duration stopped_at = e.bench.tick_until(Phase::stopped).measured_progress;
  e.bench.tick_for(300ms);
  e.start_now(stopped_at);
  const ArmFeedback& feedback = e.bench.tick();
  EXPECT_EQ(feedback.phase, Phase::moving);
  EXPECT_LT(feedback.commanded_progress - stopped_at, 100us);  // it ramps up
  e.bench.tick_until(Phase::finished);
  EXPECT_EQ(feedback.measured.head(7), e.trajectory->goal());
}

TEST(SimulatedArm, KeepsItsLimitsThroughRandomBrakesAndContinuations) {
  for (const Pieces pieces : {Pieces::quintic, Pieces::cubic}) {
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
      std::mt19937_64 random(seed);
      const CellPtr cell = two_arm_cell({.brake_per_acceleration = seed % 2 == 0 ? 1.0 : 2.0});
      const TrajectoryPtr trajectory =
          random_trajectory(*cell, joints_of(*cell, kLeft), {kLeft}, random, pieces);
      Bench bench(cell, kLeft, *trajectory);
      AccelerationGauge gauge(*cell, trajectory);
      bench.command.start(trajectory, at(0ms), {}, trajectory->duration());
      for (int i = 0; i < 200'000; ++i) {
        const ArmFeedback& feedback = bench.tick();
        gauge.observe(feedback,
                      feedback.phase == Phase::braking || feedback.phase == Phase::stopped);
        if (feedback.phase == Phase::finished) break;
        if (feedback.phase == Phase::moving && random() % 500 == 0) bench.command.brake();
        if (feedback.phase == Phase::stopped) {
          bench.command.start(trajectory, bench.now, feedback.measured_progress,
                              trajectory->duration());
        }
      }
      EXPECT_EQ(bench.tick().phase, Phase::finished) << seed;
      EXPECT_LE(gauge.worst_share(), 1.0 + cell->checking.limit_tolerance)
          << "seed " << seed << (pieces == Pieces::cubic ? " cubic" : " quintic");
    }
  }
}

TEST(SimulatedArm, BrakedBeforeItsStartStopsAtOnceAndCanBeReleased) {
  Example e;
  e.bench.command.start(e.trajectory, at(1s), {}, e.trajectory->duration());
  e.bench.tick_for(10ms);
  e.bench.command.brake();
  const ArmFeedback& feedback = e.bench.tick();
  EXPECT_EQ(feedback.phase, Phase::stopped);
  EXPECT_EQ(feedback.measured_progress, 0ms);
  e.bench.tick_for(2s);
  EXPECT_EQ(feedback.phase, Phase::stopped);
  EXPECT_EQ(feedback.measured, at_start(*e.trajectory, *e.cell, kLeft));
  e.bench.command.release();
  EXPECT_EQ(e.bench.tick().phase, Phase::idle);
}

}  // namespace
}  // namespace armloom
