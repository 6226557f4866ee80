#include <gtest/gtest.h>

#include <algorithm>

#include "test/arm/arm_fixture.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;
using Phase = ArmFeedback::Phase;

Duration share_of(Duration whole, std::mt19937_64& random) {
  return Duration(static_cast<Duration::rep>(random() % static_cast<std::uint64_t>(whole.count())));
}

struct Case {
  explicit Case(std::uint64_t seed)
      : random(seed),
        cell(two_arm_cell({.brake_per_acceleration = seed % 3 == 0 ? 1.0 : 2.0})),
        trajectory(random_trajectory(*cell, joints_of(*cell, kLeft), {kLeft}, random,
                                     seed % 4 == 0 ? Pieces::cubic : Pieces::quintic)),
        bench(cell, kLeft, *trajectory),
        gauge(*cell, trajectory) {}

  std::mt19937_64 random;
  CellPtr cell;
  TrajectoryPtr trajectory;
  Bench bench;
  AccelerationGauge gauge;
};

TEST(Authority, IsReachedButNeverExceeded) {
  double worst = 0.0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Case c(seed);
    const Duration duration = c.trajectory->duration();
    Duration authority = share_of(duration, c.random);
    c.bench.command.start(c.trajectory, at(0ms), {}, authority);
    int at_rest = 0;
    for (int i = 0; i < 200'000; ++i) {
      const ArmFeedback& feedback = c.bench.tick();
      ASSERT_LE(feedback.commanded_progress, authority) << seed;
      ASSERT_LE(feedback.measured_progress, feedback.commanded_progress) << seed;
      c.gauge.observe(feedback, true);
      if (feedback.phase == Phase::finished) break;
      ASSERT_EQ(feedback.phase, Phase::moving) << seed;
      at_rest = feedback.measured_progress == authority ? at_rest + 1 : 0;
      if (at_rest > 50 || c.random() % 400 == 0) {
        authority += share_of(duration / 4, c.random) + 1us;
        c.bench.command.grant(authority);
      }
    }
    EXPECT_EQ(c.bench.tick().phase, Phase::finished) << seed;
    EXPECT_LE(c.gauge.worst_share(), 1.0 + c.cell->checking.limit_tolerance) << seed;
    worst = std::max(worst, c.gauge.worst_share());
  }
  RecordProperty("worst_share", std::to_string(worst));
}

TEST(Authority, ArmRestsExactlyAtItsAuthority) {
  Case c(5);
  const Duration authority = c.trajectory->duration() / 2;
  c.bench.command.start(c.trajectory, at(0ms), {}, authority);
  const ArmFeedback& feedback = c.bench.tick_for(authority + 600ms);
  EXPECT_EQ(feedback.phase, Phase::moving);
  EXPECT_EQ(feedback.measured_progress, authority);
  EXPECT_EQ(c.bench.tick_for(1s).measured_progress, authority);
}

TEST(Authority, TimelyExtensionCausesNoDelay) {
  Case c(2);
  const Duration duration = c.trajectory->duration();
  c.bench.command.start(c.trajectory, at(0ms), {}, 800ms);
  Duration authority = 800ms;
  while (c.bench.now < at(duration)) {
    const ArmFeedback& feedback = c.bench.tick();
    ASSERT_EQ(feedback.commanded_progress,
              std::min<Duration>(c.bench.now.time_since_epoch(), duration));
    c.bench.command.grant(authority += kControlPeriod);
  }
}

TEST(Authority, ZeroAuthorityKeepsTheArmAtRest) {
  Case c(1);
  c.bench.command.start(c.trajectory, at(0ms), {}, 0ms);
  EXPECT_EQ(c.bench.tick_for(100ms).commanded_progress, 0ms);
  c.bench.command.grant(c.trajectory->duration());
  EXPECT_EQ(c.bench.tick_for(10ms).commanded_progress, 10ms);
  c.bench.tick_until(Phase::finished);
}

TEST(Authority, ReducedAuthorityStopsNoLaterThanABrake) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    Case c(seed);
    Case braked(seed);
    const Duration duration = c.trajectory->duration();
    const Duration run = duration / 4 + share_of(duration / 4, c.random);
    const Duration ahead = share_of(duration / 3, c.random);
    c.bench.command.start(c.trajectory, at(0ms), {}, duration);
    braked.bench.command.start(braked.trajectory, at(0ms), {}, duration);
    const Duration here = c.bench.tick_for(run).commanded_progress;
    c.gauge.observe(braked.bench.tick_for(run), true);
    braked.bench.command.brake();
    while (braked.bench.tick().phase == Phase::braking) {
    }
    const Duration brake_stop = braked.bench.tick().measured_progress;
    c.bench.command.grant(here + ahead);
    for (int i = 0; i < 12'000; ++i) c.gauge.observe(c.bench.tick(), true);
    const Duration expected = std::max(here + ahead, brake_stop);
    EXPECT_EQ(c.bench.tick().measured_progress, expected) << seed;
    EXPECT_LE(c.gauge.worst_share(), 1.0 + c.cell->checking.limit_tolerance) << seed;
  }
}

TEST(Authority, BrakeStopsBeforeTheAuthorityAndMotionContinues) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    Case c(seed);
    const Duration duration = c.trajectory->duration();
    const Duration authority = duration / 2;
    c.bench.command.start(c.trajectory, at(0ms), {}, authority);
    c.gauge.observe(c.bench.tick(), true);
    for (Duration t{}; t < authority * 9 / 10; t += kControlPeriod) {
      c.gauge.observe(c.bench.tick(), true);
    }
    c.bench.command.brake();
    Duration stopped_at{};
    while (true) {
      const ArmFeedback& feedback = c.bench.tick();
      c.gauge.observe(feedback, true);
      stopped_at = feedback.measured_progress;
      ASSERT_LE(feedback.commanded_progress, authority) << seed;
      if (feedback.phase == Phase::stopped) break;
    }
    c.bench.command.start(c.trajectory, c.bench.now, stopped_at, duration);
    while (true) {
      const ArmFeedback& feedback = c.bench.tick();
      c.gauge.observe(feedback, true);
      if (feedback.phase == Phase::finished) break;
    }
    EXPECT_LE(c.gauge.worst_share(), 1.0 + c.cell->checking.limit_tolerance) << seed;
  }
}

}  // namespace
}  // namespace armloom
