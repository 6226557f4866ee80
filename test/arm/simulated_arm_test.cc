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
  e.bench.command.start(e.trajectory, at(12ms + 300us), {}, e.trajectory->duration());
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
  e.bench.command.start(e.trajectory, at(40ms), {}, e.trajectory->duration());
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
  e.bench.command.start(second, e.bench.now, {}, second->duration());
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
  Commander(arm).start(trajectory, at(0ms), {}, trajectory->duration());
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
    for (Bench* bench : {&left, &right})
      bench->command.start(both, bench->now, from, both->duration());
    for (int i = 0; i < 1500; ++i) {
      if (i == 500) left.command.brake();
      if (i == 500) right.command.brake();
      from = left.tick().commanded_progress;
      ASSERT_EQ(from, right.tick().commanded_progress) << round << " " << i;
    }
  }
}

TEST(SimulatedArm, IsDeterministicForASeed) {
  const auto run = [](std::uint64_t seed) {
    Example e({.noise_rad = 0.001}, 1);
    Bench bench(e.cell, kLeft, *e.trajectory, seed);
    bench.command.start(e.trajectory, at(5ms), {}, e.trajectory->duration());
    std::vector<double> all;
    for (int i = 0; i < 3000; ++i) {
      if (i == 700) bench.command.brake();
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
  Commander(arm).start(e.trajectory, at(0ms), {}, e.trajectory->duration());
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

TEST(SimulatedArm, RejectsCommandsThatItCannotCarryOut) {
  Example e;
  const TrajectoryPtr foreign =
      random_trajectory(*e.cell, joints_of(*e.cell, kRight), {kRight}, e.random);
  const auto expect_rejected = [&](const std::string& why, ArmFeedback::Phase phase) {
    const ArmFeedback& feedback = e.bench.tick();
    EXPECT_EQ(feedback.rejected, e.bench.command.number);
    EXPECT_EQ(feedback.acknowledged, e.bench.command.number);
    EXPECT_NE(feedback.detail.find(why), std::string::npos) << feedback.detail;
    EXPECT_EQ(feedback.phase, phase) << why;
  };
  e.bench.command.grant(1s);
  expect_rejected("no motion", Phase::idle);
  e.start_now(1s);  // the arm is at the start, not at 1 s
  expect_rejected("rad from the trajectory", Phase::fault);
  e.start_now(e.trajectory->duration() + 1ms);
  expect_rejected("outside the trajectory", Phase::fault);
  e.start_now(-1ms);
  expect_rejected("outside the trajectory", Phase::fault);
  e.bench.command.start(nullptr, at(0ms), {}, 1s);
  expect_rejected("no trajectory", Phase::fault);
  e.bench.command.start(foreign, at(0ms), {}, 1s);
  expect_rejected("no joint of the arm", Phase::fault);
  e.bench.command.release();
  EXPECT_EQ(e.bench.tick().phase, Phase::idle);
  e.start_now();
  e.bench.tick();
  e.start_now();
  expect_rejected("in motion", Phase::moving);
  e.bench.command.release();
  expect_rejected("in motion", Phase::moving);
  EXPECT_THROW((void)e.bench.arm.tick(at(0ms)), std::logic_error);
  EXPECT_THROW(SimulatedArm(e.cell, kLeft, Eigen::VectorXd::Zero(7), 1), std::logic_error);
}

TEST(SimulatedArm, IgnoresCommandsOutOfTheirOrder) {
  Example e;
  const ArmCommand follow{
      1, ArmCommand::Follow{e.trajectory, at(0ms), Duration{}, e.trajectory->duration()}};
  const ArmCommand brake{2, ArmCommand::Brake{}};
  e.bench.arm.send(brake);
  EXPECT_EQ(e.bench.tick().acknowledged, 0u);
  e.bench.arm.send(follow);
  e.bench.tick();
  e.bench.arm.send(follow);  // sent twice: no second start
  EXPECT_EQ(e.bench.tick().phase, Phase::moving);
  e.bench.arm.send(brake);
  e.bench.arm.send(follow);
  EXPECT_EQ(e.bench.tick().phase, Phase::braking);
  EXPECT_EQ(e.bench.tick().acknowledged, 2u);
}

TEST(SimulatedArm, SwitchesItsDrivesOffAtRestAfterACategory1Stop) {
  Example e;
  e.start_now();
  e.bench.tick_for(600ms);
  e.bench.command.brake(StopCategory::brake_then_switch_off);
  EXPECT_TRUE(e.bench.tick().drives_on);
  const ArmFeedback& feedback = e.bench.tick_until(Phase::stopped);
  EXPECT_FALSE(feedback.drives_on);
  EXPECT_LT(e.off_path(feedback, feedback.measured_progress), 1e-12);
  e.start_now(feedback.measured_progress);
  EXPECT_TRUE(e.bench.tick().drives_on);
  e.bench.tick_until(Phase::finished);
}

TEST(SimulatedArm, LeavesItsPathInACategory0Stop) {
  Example e;
  e.start_now();
  const Duration at = e.bench.tick_for(e.trajectory->duration() / 2).measured_progress;
  e.bench.command.brake(StopCategory::switch_off);
  const ArmFeedback& feedback = e.bench.tick_until(Phase::fault, 2s);
  EXPECT_FALSE(feedback.drives_on);
  EXPECT_TRUE(feedback.at_rest);
  EXPECT_GT(e.off_path(feedback, at), 0.01) << "it went on without a brake";
  const Eigen::VectorXd rest = feedback.measured;
  EXPECT_EQ(e.bench.tick_for(100ms).measured, rest);
}

TEST(SimulatedArm, ReportsOncePerFeedbackPeriod) {
  auto cell = std::make_shared<Cell>(*two_arm_cell());
  cell->robots[0].controller.feedback_period = 8ms;
  SimulatedArm arm(cell, kLeft, Eigen::VectorXd::Zero(8), 1);
  int reports = 0;
  std::uint64_t last = 0;
  for (TimePoint now{}; now < at(80ms); now += kControlPeriod) {
    while (const ArmFeedback* report = arm.poll(now)) {
      EXPECT_EQ(report->sequence, ++last);
      EXPECT_EQ(report->controller_time, now.time_since_epoch());
      ++reports;
    }
  }
  EXPECT_EQ(reports, 10);
}

TEST(FaultyArm, ReportsNothingWhileItDropsItsFeedback) {
  const Example example;
  const TrajectoryPtr& path = example.trajectory;
  FaultyArm arm(std::make_unique<SimulatedArm>(example.cell, kLeft,
                                               at_start(*path, *example.cell, kLeft), 1));
  TimePoint now{};
  ArmFeedback last;
  const auto reports_in = [&](Duration time) {
    int reports = 0;
    for (const TimePoint end = now + time; now < end;) {
      now += kControlPeriod;
      while (const ArmFeedback* report = arm.poll(now)) {
        last = *report;
        ++reports;
      }
    }
    return reports;
  };
  Commander(arm).start(path, now, {}, path->duration());
  const Duration part = path->duration() / 4 / kControlPeriod * kControlPeriod;
  EXPECT_EQ(reports_in(part), part / kControlPeriod);
  const Duration before = last.measured_progress;
  arm.inject(1, {.kind = ArmFault::Kind::drop_feedback, .from = now, .until = now + part});
  EXPECT_LE(reports_in(part), 1);
  EXPECT_GT(reports_in(8 * kControlPeriod), 6);
  EXPECT_GT(last.measured_progress, before + part / 2) << "the arm went on";
}

}  // namespace
}  // namespace armloom
