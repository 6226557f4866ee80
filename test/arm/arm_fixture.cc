#include "test/arm/arm_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace armloom {
namespace {

constexpr std::size_t kJoints = 7;
constexpr std::array<double, kJoints> kVelocity{2.175, 2.175, 2.175, 2.175, 2.61, 2.61, 2.61};

Joint revolute_joint(ArmId arm, const std::string& name, double velocity,
                     const CellOptions& options) {
  return {.name = name,
          .robot = RobotId(arm.value()),
          .arm = arm,
          .kind = JointKind::revolute,
          .lower = -2.9,
          .upper = 2.9,
          .velocity_max = velocity,
          .acceleration_max = kDefaultAcceleration,
          .jerk_max = kDefaultJerk,
          .brake = options.brake_per_acceleration * kDefaultAcceleration};
}

struct Waypoint {
  Eigen::VectorXd q;
  Eigen::VectorXd v;
  Eigen::VectorXd a;
};

// Returns the quintic (or cubic) through position and velocity (and acceleration) at both ends.
Segment piece(const Waypoint& from, const Waypoint& to, Duration start, Duration duration,
              Pieces pieces) {
  const double t = to_seconds(duration);
  Segment segment{start, duration, {}};
  auto& c = segment.coefficients;
  c.setZero(from.q.size(), 6);
  const Eigen::VectorXd d = to.q - from.q;
  c.col(0) = from.q;
  c.col(1) = from.v;
  if (pieces == Pieces::cubic) {
    c.col(2) = (3.0 * d - (2.0 * from.v + to.v) * t) / (t * t);
    c.col(3) = (-2.0 * d + (from.v + to.v) * t) / (t * t * t);
    return segment;
  }
  const double t2 = t * t;
  c.col(2) = 0.5 * from.a;
  c.col(3) =
      (20.0 * d - (8.0 * to.v + 12.0 * from.v) * t - (3.0 * from.a - to.a) * t2) / (2.0 * t2 * t);
  c.col(4) = (-30.0 * d + (14.0 * to.v + 16.0 * from.v) * t + (3.0 * from.a - 2.0 * to.a) * t2) /
             (2.0 * t2 * t2);
  c.col(5) = (12.0 * d - 6.0 * (to.v + from.v) * t - (from.a - to.a) * t2) / (2.0 * t2 * t2 * t);
  return segment;
}

std::vector<Segment> joined(const std::vector<Waypoint>& waypoints,
                            const std::vector<double>& durations_s, double slower, Pieces pieces) {
  std::vector<Segment> segments;
  Duration start{};
  for (std::size_t i = 0; i + 1 < waypoints.size(); ++i) {
    const auto scaled = [&](const Waypoint& w) {
      return Waypoint{w.q, w.v / slower, w.a / (slower * slower)};
    };
    const Duration duration = from_seconds(durations_s[i] * slower);
    segments.push_back(
        piece(scaled(waypoints[i]), scaled(waypoints[i + 1]), start, duration, pieces));
    start += duration;
  }
  return segments;
}

// Returns the factor by which the time must grow to meet all limits.
double needed_slowdown(const Trajectory& trajectory, const Cell& cell) {
  JointState state;
  double needed = 0.0;
  for (Duration s{}; s < trajectory.duration(); s += trajectory.duration() / 4000) {
    trajectory.sample(s, state);
    for (std::size_t j = 0; j < trajectory.joints().size(); ++j) {
      const Joint& joint = cell.joint(trajectory.joints()[j]);
      const auto i = static_cast<Eigen::Index>(j);
      needed = std::max(needed, std::abs(state.velocity[i]) / joint.velocity_max);
      needed =
          std::max(needed, std::sqrt(std::abs(state.acceleration[i]) / joint.acceleration_max));
    }
  }
  return needed;
}

}  // namespace

CellPtr two_arm_cell(CellOptions options) {
  auto cell = std::make_shared<Cell>();
  for (const ArmId arm : {kLeft, kRight}) {
    const std::string name = arm == kLeft ? "left" : "right";
    Robot robot;
    robot.name = name;
    robot.prefix = name + "_";
    robot.arms = {arm};
    robot.controller.lag = options.lag;
    robot.controller.noise_rad = options.noise_rad;
    cell->robots.push_back(std::move(robot));
    Arm description{.name = name,
                    .robot = RobotId(arm.value()),
                    .group = "arm",
                    .joints = {},
                    .gripper_joints = {},
                    .links = {},
                    .home = Eigen::VectorXd::Zero(kJoints),
                    .named_states = {}};
    for (std::size_t j = 0; j < kJoints; ++j) {
      description.joints.emplace_back(static_cast<std::uint32_t>(cell->joints.size()));
      cell->joints.push_back(
          revolute_joint(arm, name + "_joint" + std::to_string(j + 1), kVelocity[j], options));
    }
    if (arm == kLeft) {
      description.gripper_joints.emplace_back(static_cast<std::uint32_t>(cell->joints.size()));
      cell->joints.push_back(revolute_joint(arm, "left_finger", 0.2, options));
      cell->joints.back().kind = JointKind::prismatic;
    }
    cell->arms.push_back(std::move(description));
  }
  return cell;
}

std::vector<JointId> joints_of(const Cell& cell, ArmId arm) { return cell.arm(arm).joints; }

TrajectoryPtr random_trajectory(const Cell& cell, std::vector<JointId> joints,
                                std::vector<ArmId> arms, std::mt19937_64& random, Pieces pieces) {
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random() >> 11U) * 0x1.0p-53);
  };
  const auto vector = [&](double reach) {
    Eigen::VectorXd v(static_cast<Eigen::Index>(joints.size()));
    for (double& x : v) x = uniform(-reach, reach);
    return v;
  };
  const std::size_t count = 2 + static_cast<std::size_t>(random() % 6);
  std::vector<Waypoint> waypoints;
  std::vector<double> durations_s;
  for (std::size_t i = 0; i < count; ++i) {
    const bool inner = i > 0 && i + 1 < count;
    waypoints.push_back({vector(2.0), vector(inner ? 1.0 : 0.0), vector(inner ? 1.0 : 0.0)});
    durations_s.push_back(uniform(0.5, 2.0));
  }
  const Trajectory raw(joints, arms, joined(waypoints, durations_s, 1.0, pieces));
  const double slower = needed_slowdown(raw, cell);
  return std::make_shared<const Trajectory>(std::move(joints), std::move(arms),
                                            joined(waypoints, durations_s, slower, pieces));
}

Eigen::VectorXd at_start(const Trajectory& trajectory, const Cell& cell, ArmId arm) {
  std::vector<JointId> joints = cell.arm(arm).joints;
  joints.insert(joints.end(), cell.arm(arm).gripper_joints.begin(),
                cell.arm(arm).gripper_joints.end());
  Eigen::VectorXd q = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(joints.size()));
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const auto found = std::find(trajectory.joints().begin(), trajectory.joints().end(), joints[j]);
    if (found == trajectory.joints().end()) continue;
    q[static_cast<Eigen::Index>(j)] = trajectory.start()[found - trajectory.joints().begin()];
  }
  return q;
}

const ArmFeedback& Bench::tick_until(ArmFeedback::Phase phase, Duration most) {
  const TimePoint end = now + most;
  while (true) {
    const ArmFeedback& feedback = tick();
    if (feedback.phase == phase) return feedback;
    if (now >= end) {
      ADD_FAILURE() << "phase " << static_cast<int>(feedback.phase) << " instead of "
                    << static_cast<int>(phase) << " at progress "
                    << to_seconds(feedback.commanded_progress);
      return feedback;
    }
  }
}

AccelerationGauge::AccelerationGauge(const Cell& cell, TrajectoryPtr trajectory)
    : trajectory_(std::move(trajectory)) {
  const auto size = static_cast<Eigen::Index>(trajectory_->joints().size());
  acceleration_.resize(size);
  brake_.resize(size);
  for (Eigen::Index j = 0; j < size; ++j) {
    const Joint& joint = cell.joint(trajectory_->joints()[static_cast<std::size_t>(j)]);
    acceleration_[j] = joint.acceleration_max;
    brake_[j] = joint.brake;
  }
}

void AccelerationGauge::observe(const ArmFeedback& feedback, bool may_brake, double brake) {
  const double tick_s = to_seconds(kControlPeriod);
  before_.swap(last_);
  last_.swap(now_);
  trajectory_->sample_positions(feedback.commanded_progress, now_);
  if (++known_ >= 3) {
    // Progress is in whole nanoseconds.
    const double rounding = 4.0 * 0.5e-9 * 2.61 / (tick_s * tick_s);
    const Eigen::ArrayXd found =
        (now_ - 2.0 * last_ + before_).array().abs() / (tick_s * tick_s) - rounding;
    const Eigen::VectorXd& limit = may_brake || braked_before_ ? brake_ : acceleration_;
    worst_share_ = std::max(worst_share_, (found / (brake * limit.array())).maxCoeff());
  }
  braked_before_ = may_brake;
}

}  // namespace armloom
