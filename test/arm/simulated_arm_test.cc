#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <stdexcept>

#include "core/arm/faulty_arm.h"
#include "test/arm/started_arm.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;
using Phase = ArmFeedback::Phase;

TEST(SimulatedArm, IsIdleUntilTheFirstStart) {
  Example e;
  const Eigen::VectorXd q = at_start(*e.trajectory, *e.cell, kLeft);
  const ArmFeedback& feedback = e.bench.tick_for(100ms);
  EXPECT_EQ(feedback.phase, Phase::idle);
  EXPECT_EQ(feedback.measured, q);
  EXPECT_EQ(e.bench.arm.joints().size(), 8u);  // seven arm joints and the gripper joint
}

TEST(SimulatedArm, TakesTheTrajectorysDurationPlusItsLag) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Example e({}, seed);
    e.start_now();
    const Duration duration = e.trajectory->duration();
    const auto whole_ticks = duration / kControlPeriod;
    const ArmFeedback& feedback = e.bench.tick_for(whole_ticks * kControlPeriod);
    EXPECT_EQ(feedback.commanded_progress, whole_ticks * kControlPeriod) << seed;
    e.bench.tick();
    EXPECT_EQ(feedback.commanded_progress, duration) << seed;
    e.bench.tick_until(Phase::finished);
    EXPECT_LT(e.bench.now - at(duration), 200ms) << seed;
    EXPECT_EQ(feedback.measured.head(7), e.trajectory->goal()) << seed;  // to the last bit
    EXPECT_EQ(feedback.measured_progress, duration) << seed;
    EXPECT_EQ(e.bench.tick_for(50ms).phase, Phase::finished) << seed;
  }
}

TEST(SimulatedArm, MeasuresTheCommandedProgressWithoutLag) {
  Example e({.lag = 0ms});
  e.start_now();
  for (int i = 0; i < 1000; ++i) {
    const ArmFeedback& feedback = e.bench.tick();
    ASSERT_EQ(feedback.measured_progress, feedback.commanded_progress);
  }
  e.bench.tick_until(Phase::finished);
  EXPECT_LT(e.bench.now - at(e.trajectory->duration()), kControlPeriod);
}

TEST(SimulatedArm, MeasuredProgressFollowsTheCommandByTheLag) {
  Example e({.lag = 35ms});
  e.start_now();
  e.bench.tick_for(400ms);
  for (int i = 0; i < 200; ++i) {
    const ArmFeedback& feedback = e.bench.tick();
    const Duration behind = feedback.commanded_progress - feedback.measured_progress;
    EXPECT_NEAR(to_seconds(behind), 0.035, 1e-6);
    EXPECT_LT(e.off_path(feedback, feedback.measured_progress), 1e-12);
  }
}

TEST(SimulatedArm, StartBetweenTwoTicksLosesNoTime) {
  Example e;
  e.bench.tick_for(10ms);
  e.bench.arm.start(e.trajectory, at(12ms + 300us), {}, e.trajectory->duration());
  EXPECT_EQ(e.bench.tick().phase, Phase::waiting);
  EXPECT_EQ(e.bench.tick().phase, Phase::waiting);
  const ArmFeedback& feedback = e.bench.tick();
  EXPECT_EQ(feedback.phase, Phase::moving);
  EXPECT_EQ(feedback.commanded_progress, 700us);
  e.bench.tick_for(500ms);
  EXPECT_EQ(feedback.commanded_progress, 500ms + 700us);
}

TEST(SimulatedArm, StartInThePastStartsAtTheNextTick) {
  Example e;
  e.bench.tick_for(100ms);
  e.bench.arm.start(e.trajectory, at(40ms), {}, e.trajectory->duration());
  EXPECT_EQ(e.bench.tick().commanded_progress, 0ms);
  EXPECT_EQ(e.bench.tick().commanded_progress, 1ms);
}

TEST(SimulatedArm, RunsOneTrajectoryAfterAnother) {
  Example e;
  e.start_now();
  e.bench.tick_until(Phase::finished);
  std::vector<Segment> segments;
  Segment back{{}, from_seconds(6.0), {}};
  back.coefficients.setZero(7, 6);
  const Eigen::VectorXd way = e.trajectory->start() - e.trajectory->goal();
  back.coefficients.col(0) = e.trajectory->goal();
  back.coefficients.col(2) = 3.0 * way / 36.0;
  back.coefficients.col(3) = -2.0 * way / 216.0;
  segments.push_back(back);
  const auto second =
      std::make_shared<const Trajectory>(joints_of(*e.cell, kLeft), std::vector{kLeft}, segments);
  e.bench.arm.start(second, e.bench.now, {}, second->duration());
  const ArmFeedback& feedback = e.bench.tick_until(Phase::finished);
  EXPECT_LT((feedback.measured.head(7) - e.trajectory->start()).norm(), 1e-12);
}

TEST(SimulatedArm, JointsOutsideTheTrajectoryDoNotMove) {
  Example e;
  const std::vector<JointId> some{JointId(2), JointId(9),
                                  JointId(3)};  // joint 9 is the right arm's
  const TrajectoryPtr trajectory = random_trajectory(*e.cell, some, {kLeft, kRight}, e.random);
  Eigen::VectorXd q = Eigen::VectorXd::LinSpaced(8, 0.1, 0.8);
  q[2] = trajectory->start()[0];
  q[3] = trajectory->start()[2];
  SimulatedArm arm(e.cell, kLeft, q, 1);
  arm.start(trajectory, at(0ms), {}, trajectory->duration());
  TimePoint now{};
  while (arm.tick(now += kControlPeriod).phase != Phase::finished) {
  }
  const ArmFeedback& feedback = arm.tick(now);
  q[2] = trajectory->goal()[0];
  q[3] = trajectory->goal()[2];
  EXPECT_EQ(feedback.measured, q);
}

TEST(SimulatedArm, ArmsOfOneSynchronousTrajectoryBrakeAndContinueInStep) {
  std::mt19937_64 random(7);
  const CellPtr cell = two_arm_cell();
  std::vector<JointId> joints = joints_of(*cell, kLeft);
  for (const JointId joint : joints_of(*cell, kRight)) joints.push_back(joint);
  const TrajectoryPtr both = random_trajectory(*cell, joints, {kLeft, kRight}, random);
  Bench left(cell, kLeft, *both);
  Bench right(cell, kRight, *both);
  Duration from{};
  for (int round = 0; round < 3; ++round) {
    for (Bench* bench : {&left, &right}) bench->arm.start(both, bench->now, from, both->duration());
    for (int i = 0; i < 1500; ++i) {
      if (i == 500) left.arm.brake();
      if (i == 500) right.arm.brake();
      from = left.tick().commanded_progress;
      ASSERT_EQ(from, right.tick().commanded_progress) << round << " " << i;
    }
  }
}

TEST(SimulatedArm, IsDeterministicForASeed) {
  const auto run = [](std::uint64_t seed) {
    Example e({.noise_rad = 0.001}, 1);
    Bench bench(e.cell, kLeft, *e.trajectory, seed);
    bench.arm.start(e.trajectory, at(5ms), {}, e.trajectory->duration());
    std::vector<double> all;
    for (int i = 0; i < 3000; ++i) {
      if (i == 700) bench.arm.brake();
      const ArmFeedback& feedback = bench.tick();
      all.insert(all.end(), feedback.measured.begin(), feedback.measured.end());
    }
    return all;
  };
  EXPECT_EQ(run(3), run(3));
  EXPECT_NE(run(3), run(4));
}

TEST(SimulatedArm, NoiseHasTheStatedSizeAndAffectsOnlyMeasurements) {
  Example e({.noise_rad = 0.05});
  const Eigen::VectorXd q = at_start(*e.trajectory, *e.cell, kLeft);
  double sum = 0.0;
  double squares = 0.0;
  constexpr int kTicks = 5000;
  for (int i = 0; i < kTicks; ++i) {
    const Eigen::VectorXd error = e.bench.tick().measured - q;
    sum += error.sum();
    squares += error.squaredNorm();
  }
  EXPECT_NEAR(sum / (8.0 * kTicks), 0.0, 1e-3);
  EXPECT_NEAR(std::sqrt(squares / (8.0 * kTicks)), 0.05, 1e-3);
  e.start_now();  // throws if the noise had moved the arm past the start tolerance
  e.bench.tick_until(Phase::finished);
}

TEST(SimulatedArm, StartSlightlyOffThePathIsPulledInSmoothly) {
  Example e;
  Eigen::VectorXd q = at_start(*e.trajectory, *e.cell, kLeft);
  q[1] += 0.009;
  SimulatedArm arm(e.cell, kLeft, q, 1);
  arm.start(e.trajectory, at(0ms), {}, e.trajectory->duration());
  TimePoint now{};
  Eigen::VectorXd last = q;
  ArmFeedback feedback;
  do {
    feedback = arm.tick(now += kControlPeriod);
    EXPECT_LT((feedback.measured - last).cwiseAbs().maxCoeff(), 0.004);  // no jump
    last = feedback.measured;
  } while (feedback.phase != Phase::finished);
  EXPECT_EQ(feedback.measured.head(7), e.trajectory->goal());
}

TEST(SimulatedArm, ThrowsOnViolatedPreconditions) {
  Example e;
  EXPECT_THROW(e.bench.arm.grant(1s), std::logic_error);
  EXPECT_THROW(e.start_now(1s), std::logic_error);  // the arm is at the start, not at 1 s
  EXPECT_THROW(e.start_now(e.trajectory->duration() + 1ms), std::logic_error);
  EXPECT_THROW(e.start_now(-1ms), std::logic_error);
  EXPECT_THROW(e.bench.arm.start(nullptr, at(0ms), {}, 1s), std::logic_error);
  const TrajectoryPtr foreign =
      random_trajectory(*e.cell, joints_of(*e.cell, kRight), {kRight}, e.random);
  EXPECT_THROW(e.bench.arm.start(foreign, at(0ms), {}, 1s), std::logic_error);
  EXPECT_EQ(e.bench.tick().phase, Phase::idle);  // none of these calls changed the arm
  e.start_now();
  EXPECT_THROW(e.start_now(), std::logic_error);
  EXPECT_THROW(e.bench.arm.release(), std::logic_error);
  e.bench.tick();
  EXPECT_THROW((void)e.bench.arm.tick(at(0ms)), std::logic_error);
  EXPECT_THROW(SimulatedArm(e.cell, kLeft, Eigen::VectorXd::Zero(7), 1), std::logic_error);
}

TEST(FaultyArm, FreezesItsFeedbackWhileItDropsIt) {
  const Example example;
  const TrajectoryPtr& path = example.trajectory;
  FaultyArm arm(std::make_unique<SimulatedArm>(example.cell, kLeft,
                                               at_start(*path, *example.cell, kLeft), 1));
  TimePoint now{};
  const auto tick_for = [&](Duration time) {
    for (const TimePoint end = now + time; now < end;) arm.tick(now += kControlPeriod);
    return arm.tick(now += kControlPeriod);
  };
  arm.start(path, now, {}, path->duration());
  const Duration part = path->duration() / 4;
  tick_for(part);
  arm.inject(1, {.kind = ArmFault::Kind::drop_feedback, .from = now, .until = now + part});
  const ArmFeedback before = arm.tick(now += kControlPeriod);
  const ArmFeedback during = tick_for(part - 4 * kControlPeriod);
  EXPECT_EQ(during.measured, before.measured);
  EXPECT_EQ(during.measured_progress, before.measured_progress);
  const ArmFeedback after = tick_for(8 * kControlPeriod);
  EXPECT_GT(after.measured_progress, before.measured_progress + part / 2) << "it went on";
}

}  // namespace
}  // namespace armloom
