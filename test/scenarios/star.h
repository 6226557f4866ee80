#pragma once

#include <string>
#include <vector>

#include "test/scenarios/crossing.h"

namespace armloom {

// Returns sliders in one plane, all through the origin, at equal angles.
inline CellDescription star(std::size_t arms) {
  CellDescription cell = crossing_description();
  const RobotDescription first = cell.robots[0];
  cell.robots.clear();
  for (std::size_t i = 0; i < arms; ++i) {
    RobotDescription robot = first;
    const std::string name(1, static_cast<char>('a' + i));
    robot.name = robot.arms[0].name = name;
    robot.prefix = name + "_";
    const double turned = std::numbers::pi * static_cast<double>(i) / static_cast<double>(arms);
    robot.X_WB.linear() = Eigen::AngleAxisd(turned, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    cell.robots.push_back(std::move(robot));
  }
  cell.scheduling.backlog_timeout = 300s;
  return cell;
}

// Records the smallest measured distance between the balls.
struct SmallestDistance final : Observer {
  explicit SmallestDistance(std::size_t arms) : count(arms) {}
  void on_event(const Event&) override {}
  void on_state(const StateFrame&) override {}
  void on_tick(TimePoint now, const Configuration& measured) override {
    last = measured;
    std::vector<Eigen::Vector2d> at_m;
    for (std::size_t i = 0; i < count; ++i) {
      const double turned = std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
      const double q = measured[static_cast<Eigen::Index>(i)];
      at_m.emplace_back(q * std::cos(turned), q * std::sin(turned));
      for (std::size_t j = 0; j < i; ++j) {
        const double distance_m = (at_m[i] - at_m[j]).norm() - 0.2;
        if (distance_m < smallest_m) smallest_m = distance_m, when = now;
      }
    }
  }
  std::size_t count;
  double smallest_m = 1e9;
  TimePoint when{};
  Configuration last;
};

}  // namespace armloom
