#pragma once

#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "test/scenarios/crossing.h"

namespace armloom {

using Keys = std::vector<std::string>;

// Sliders on rails of 2 m between neighboring corners of a polygon. Each slider rests at its own
// corner, at -1 m; the next slider's corner is at +1 m. With two corners both arms share one line.
// The arm "free" is far away.
inline CellDescription polygon(int corners) {
  CellDescription cell{.name = "polygon"};
  const double turn = 2 * std::numbers::pi / corners;
  const double apothem = corners == 2 ? 0.0 : 1.0 / std::tan(turn / 2);
  for (int i = 0; i <= corners; ++i) {
    const std::string name = i == corners ? "free" : std::string(1, static_cast<char>('a' + i));
    RobotDescription robot = slider(name);
    robot.X_WB.linear() = Eigen::AngleAxisd(turn * i, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    robot.X_WB.translation() = robot.X_WB.linear() * Eigen::Vector3d(0, -apothem, 0);
    if (i == corners) robot.X_WB.translation() = Eigen::Vector3d(0, 10, 0);
    cell.robots.push_back(std::move(robot));
  }
  cell.checking.time_step = 10ms;
  cell.scheduling.on_idle_blocker = OnIdleBlocker::report;
  return cell;
}

// The time and the cycle of the first event that reports the job in a deadlock.
struct Told {
  TimePoint when;
  Keys ring;
};
inline std::optional<Told> deadlock_of(const Crossing& cell, const std::string& key) {
  for (const Event& event : cell.log.events) {
    const auto* job = std::get_if<JobView>(&event.body);
    if (job && job->key == key && !job->cycle.empty()) return Told{event.time, job->cycle};
  }
  return std::nullopt;
}

}  // namespace armloom
