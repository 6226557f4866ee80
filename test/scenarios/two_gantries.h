#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/executive/known_policies.h"
#include "core/executive/simulation.h"
#include "core/model/cell/build_cell.h"
#include "test/source_dir.h"

namespace armloom {

using namespace std::chrono_literals;

using Place_m = std::pair<double, double>;

// Returns balls of 10 cm radius, "a", "b" and so on, that can move anywhere in one plane.
inline CellDescription gantries(OnIdleBlocker on_idle_blocker, const std::vector<Place_m>& homes) {
  CellDescription cell{.name = "gantries"};
  for (std::size_t i = 0; i < homes.size(); ++i) {
    const std::string name(1, static_cast<char>('a' + i));
    RobotDescription robot{.name = name,
                           .urdf = source_dir() + "/test/scenarios/data/gantry.urdf",
                           .srdf = source_dir() + "/test/scenarios/data/gantry.srdf",
                           .prefix = name + "_"};
    ArmDescription arm{
        .name = name, .group = "axes", .home = {homes[i].first, homes[i].second}, .limits = {}};
    for (const char* joint : {"x", "y"}) arm.limits[joint].acceleration = 20.0;
    robot.arms.push_back(std::move(arm));
    cell.robots.push_back(std::move(robot));
  }
  cell.checking.time_step = 10ms;
  cell.scheduling.on_idle_blocker = on_idle_blocker;
  return cell;
}
inline CellDescription gantries(OnIdleBlocker on_idle_blocker) {
  return gantries(on_idle_blocker, {{-1.0, 0.0}, {1.0, 0.0}});
}

// Returns a straight motion from rest to rest.
inline JobRequest go(const std::string& arm, Place_m from, Place_m to, double duration_s,
                     std::string key) {
  JobRequest request{.key = std::move(key), .name = "", .trajectory = {}};
  request.trajectory.joint_names = {arm + "_x", arm + "_y"};
  const std::vector<double> zero{0.0, 0.0};
  request.trajectory.points = {{{from.first, from.second}, zero, zero, 0.0},
                               {{to.first, to.second}, zero, zero, duration_s}};
  return request;
}

inline JobRequest to_place(const std::string& arm, Place_m to, std::string key) {
  JobRequest goal{.key = std::move(key), .name = "", .trajectory = {}};
  goal.arm = arm;
  goal.move_to = PlanGoal{.joints = std::vector{to.first, to.second}, .named = {}, .pose = {}};
  return goal;
}

// Positions of four walls around the arms.
struct Walls {
  double left_m, right_m, below_m, above_m;
};
inline void put_walls(CellDescription& cell, const Walls& at) {
  constexpr double kThick_m = 0.2, kLong_m = 1.6;
  const Place_m middle{(at.left_m + at.right_m) / 2, (at.below_m + at.above_m) / 2};
  const auto wall = [&cell](const std::string& name, const Eigen::Vector3d& size, Place_m place) {
    Eigen::Isometry3d X_WO = Eigen::Isometry3d::Identity();
    X_WO.translation() = Eigen::Vector3d(place.first, place.second, 0.0);
    cell.objects.push_back({name, Box{size}, X_WO});
  };
  wall("left", {kThick_m, kLong_m, 0.3}, {at.left_m, middle.second});
  wall("right", {kThick_m, kLong_m, 0.3}, {at.right_m, middle.second});
  wall("below", {kLong_m, kThick_m, 0.3}, {middle.first, at.below_m});
  wall("above", {kLong_m, kThick_m, 0.3}, {middle.first, at.above_m});
}

// A cell of gantries on simulated time.
class TwoGantries {
 public:
  explicit TwoGantries(const CellDescription& description, const std::string& policy) {
    auto built = build_cell(description);
    if (!built) throw std::runtime_error(built.error().front().detail);
    auto created = Simulation::create(*built, ExecutiveOptions{.policy = policy}, log_);
    if (!created) throw std::runtime_error(created.error().front().detail);
    simulation_ = std::move(*created);
    simulation_->tick();
  }

  Executive& executive() { return simulation_->executive(); }
  [[nodiscard]] TimePoint now() const { return simulation_->now(); }
  JobView submit(JobRequest request) {
    auto view = executive().submit(std::move(request));
    if (!view) throw std::runtime_error(view.error().front().detail);
    return *view;
  }
  [[nodiscard]] JobView job(const std::string& key) const {
    return *simulation_->executive().job(key);
  }
  void run_until(TimePoint time) { simulation_->run_until(time); }
  void run_to_the_end(TimePoint limit = at(100s)) {
    while (!executive().all_ended() && simulation_->now() < limit) simulation_->tick();
    EXPECT_TRUE(executive().all_ended()) << "jobs hang";
  }
  void expect_at(const std::string& arm, Place_m place) const {
    const Eigen::Index first = arm == "a" ? 0 : 2;
    EXPECT_NEAR(log_.last[first], place.first, 1e-3) << arm;
    EXPECT_NEAR(log_.last[first + 1], place.second, 1e-3) << arm;
  }
  [[nodiscard]] const Configuration& measured() const { return log_.last; }
  [[nodiscard]] double closest_m() const { return log_.closest_m; }
  // Returns the largest joint speed between two ticks.
  [[nodiscard]] double fastest_m_s() const { return log_.fastest_m_s; }
  [[nodiscard]] const std::vector<Event>& events() const { return log_.events; }
  // Returns the largest distance of a's ball from the x axis.
  [[nodiscard]] double farthest_off_m() const { return log_.farthest_off_m; }
  [[nodiscard]] const Planning& planning() const { return simulation_->planning(); }

 private:
  struct Log final : Observer {
    void on_event(const Event& event) override { events.push_back(event); }
    void on_tick(TimePoint now, const Configuration& q) override {
      if (last.size() != 0 && now > before) {
        fastest_m_s =
            std::max(fastest_m_s, (q - last).cwiseAbs().maxCoeff() / to_seconds(now - before));
      }
      before = now;
      last = q;
      farthest_off_m = std::max(farthest_off_m, std::abs(q[1]));
      closest_m = std::min(closest_m, (q.head<2>() - q.tail<2>()).norm() - 0.2);
    }
    void on_state(const StateFrame&) override {}
    std::vector<Event> events;
    Configuration last;
    TimePoint before{};
    double closest_m = 1e9;
    double fastest_m_s = 0.0;
    double farthest_off_m = 0.0;
  };
  Log log_;
  std::unique_ptr<Simulation> simulation_;
};

}  // namespace armloom
