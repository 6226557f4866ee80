#include "test/scenarios/team_world.h"

#include <algorithm>
#include <numbers>

#include "test/scenarios/polygon.h"
#include "test/scenarios/star.h"
#include "test/source_dir.h"

namespace armloom {
namespace {

// Returns one arm along x that crosses two others; with four arms a second one parallel to it.
CellDescription ladder(std::size_t arms) {
  CellDescription cell = star(arms);
  const auto turn = Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ());
  for (std::size_t i = 0; i < arms; ++i) {
    Eigen::Isometry3d& X_WB = cell.robots[i].X_WB;
    const bool rung = i == 1 || i == 2;
    X_WB.linear() = rung ? turn.toRotationMatrix() : Eigen::Matrix3d::Identity().eval();
    X_WB.translation() = Eigen::Vector3d(0, i == 3 ? 0.6 : 0, 0);
    if (rung) X_WB.translation().x() = i == 1 ? -0.5 : 0.5;
  }
  return cell;
}

}  // namespace

CellDescription team_cell(Random& random) {
  const std::size_t arms = random.chance(0.6) ? 3 : 4;
  CellDescription cell;
  switch (random.index(3)) {
    case 0:
      cell = star(arms);
      break;
    case 1:
      cell = polygon(static_cast<int>(arms));
      cell.robots.pop_back();
      break;
    default:
      cell = ladder(arms);
  }
  if (random.chance(0.5)) {
    cell.scheduling.on_idle_blocker = OnIdleBlocker::park;
    for (RobotDescription& robot : cell.robots) {
      robot.srdf = source_dir() + "/test/scenarios/data/slider_with_back.srdf";
    }
  }
  cell.scheduling.backlog_timeout = from_seconds(random.uniform(5.0, 40.0));
  if (random.chance(0.3)) cell.scheduling.aging = 3s;
  cell.checking.time_step = 50ms;
  return cell;
}

WatchedTeam::WatchedTeam(const CellDescription& cell) {
  for (const RobotDescription& robot : cell.robots) X_WB.push_back(robot.X_WB);
  for (const RobotDescription& robot : cell.robots) names.push_back(robot.name);
  in_step.assign(names.size(), std::vector<bool>(names.size(), false));
}

void WatchedTeam::on_event(const Event& event) {
  events.push_back(event);
  if (std::holds_alternative<GuardEvent>(event.body)) ADD_FAILURE() << "the guard had to refuse";
  const auto* job = std::get_if<JobView>(&event.body);
  if (job == nullptr || job->state != JobState::running) return;
  const auto takes_part = [&](std::size_t arm) {
    return std::ranges::find(job->arms, names[arm]) != job->arms.end();
  };
  for (std::size_t i = 0; i < names.size(); ++i) {
    for (std::size_t j = 0; j < names.size(); ++j) {
      if (takes_part(i) || takes_part(j)) in_step[i][j] = takes_part(i) && takes_part(j);
    }
  }
}

void WatchedTeam::on_tick(TimePoint now, const Configuration& measured) {
  if (last.size() == 0 || (measured - last).cwiseAbs().maxCoeff() > 1e-9) moved_at = now;
  last = measured;
  for (std::size_t i = 0; i < X_WB.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double apart_m = (center(i) - center(j)).norm() - 0.2;
      if (in_step[i][j]) {
        if (apart_m < smallest_in_step_m) smallest_in_step_m = apart_m, when_in_step = now;
      } else if (apart_m < smallest_m) {
        smallest_m = apart_m, when = now;
      }
    }
  }
}

Eigen::Vector3d WatchedTeam::center(std::size_t arm) const {
  return X_WB[arm] * Eigen::Vector3d(last[static_cast<Eigen::Index>(arm)], 0, 0);
}

}  // namespace armloom
