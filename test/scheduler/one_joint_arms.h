#pragma once

#include <memory>
#include <string>

#include "core/model/cell.h"

namespace armloom {

// Returns one-joint arms named a, b, c, ... without geometry.
inline CellPtr one_joint_arms(std::size_t count) {
  auto cell = std::make_shared<Cell>();
  cell->scheduling.on_idle_blocker = OnIdleBlocker::report;
  cell->scheduling.horizon_steps = 1;  // one job per arm at a time, easier to follow
  cell->robots.emplace_back();
  for (std::size_t i = 0; i < count; ++i) {
    const std::string name(1, static_cast<char>('a' + i));
    const ArmId arm{static_cast<std::uint32_t>(i)};
    const JointId joint{static_cast<std::uint32_t>(i)};
    cell->joints.push_back(Joint{.name = name + "_joint",
                                 .robot = RobotId{0},
                                 .arm = arm,
                                 .kind = JointKind::revolute,
                                 .lower = -3,
                                 .upper = 3,
                                 .velocity_max = 2,
                                 .acceleration_max = 10,
                                 .jerk_max = 1000,
                                 .brake = 10});
    cell->arms.push_back(Arm{
        .name = name, .robot = RobotId{0}, .joints = {joint}, .home = Eigen::VectorXd::Zero(1)});
  }
  return cell;
}

// Arms in the way retreat to their pose "back", at -1 rad.
inline CellPtr one_joint_arms_that_park(std::size_t count) {
  auto cell = std::make_shared<Cell>(*one_joint_arms(count));
  cell->scheduling.on_idle_blocker = OnIdleBlocker::park;
  for (Arm& arm : cell->arms) arm.named_states["back"] = Eigen::VectorXd::Constant(1, -1.0);
  return cell;
}

}  // namespace armloom
