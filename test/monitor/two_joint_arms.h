#pragma once

#include <memory>
#include <vector>

#include "core/monitor/observation.h"

namespace armloom {

using namespace std::chrono_literals;

inline constexpr double kTracking = 0.001, kVelocityMax = 2.0, kBrake = 10.0;
inline constexpr Duration kTimeout = 100ms;

// Returns a cell of `count` arms with two joints each, all at home at zero. It has no links.
inline CellPtr two_joint_arms(std::uint32_t count) {
  auto cell = std::make_shared<Cell>();
  for (std::uint32_t a = 0; a < count; ++a) {
    Robot robot{.name = "r" + std::to_string(a), .prefix = {}};
    robot.controller.feedback_timeout = kTimeout;
    robot.arms = {ArmId{a}};
    cell->robots.push_back(robot);
    Arm arm{.name = "a" + std::to_string(a), .robot = RobotId{a}};
    for (std::uint32_t j = 2 * a; j < 2 * a + 2; ++j) {
      cell->joints.push_back({.name = "j" + std::to_string(j),
                              .robot = RobotId{a},
                              .arm = ArmId{a},
                              .kind = JointKind::revolute,
                              .lower = -3.0,
                              .upper = 3.0,
                              .velocity_max = kVelocityMax,
                              .acceleration_max = kBrake,
                              .jerk_max = 1000.0,
                              .brake = kBrake});
      arm.joints.push_back(JointId{j});
    }
    arm.home = Eigen::VectorXd::Zero(2);
    cell->arms.push_back(arm);
  }
  cell->checking.tracking_error_rad = kTracking;
  return cell;
}

// Returns a motion of the arm's two joints: q0 = t, q1 = t (2 - t) / 2, for 2 s.
inline TrajectoryPtr curve_of(ArmId arm) {
  Eigen::Matrix<double, Eigen::Dynamic, 6> c = Eigen::MatrixXd::Zero(2, 6);
  c(0, 1) = 1.0;
  c(1, 1) = 1.0;
  c(1, 2) = -0.5;
  return std::make_shared<Trajectory>(
      std::vector{JointId{2 * arm.value()}, JointId{2 * arm.value() + 1}}, std::vector{arm},
      std::vector{Segment{Duration{}, 2s, c}});
}

}  // namespace armloom
