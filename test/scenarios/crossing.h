#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "core/executive/known_policies.h"
#include "core/executive/simulation.h"
#include "core/model/cell/build_cell.h"
#include "test/source_dir.h"

namespace armloom {

using namespace std::chrono_literals;

// Returns a ball of 10 cm radius on a linear axis along x, home at -1 m.
inline RobotDescription slider(const std::string& name) {
  RobotDescription robot{.name = name,
                         .urdf = source_dir() + "/test/scenarios/data/slider.urdf",
                         .srdf = source_dir() + "/test/scenarios/data/slider.srdf",
                         .prefix = name + "_"};
  ArmDescription arm{.name = name, .group = "axis", .home = {-1.0}, .limits = {}};
  arm.limits["slide"].acceleration = 20.0;
  robot.arms.push_back(std::move(arm));
  return robot;
}

// Two balls of 10 cm radius on linear axes that cross at the origin: "x" slides along x and "y"
// along y, home at -1 m. They touch only if both are near the origin, within 20 cm of each other.
inline CellDescription crossing_description() {
  CellDescription cell{.name = "crossing"};
  for (const std::string name : {"x", "y"}) {
    RobotDescription robot = slider(name);
    if (name == "y") {
      robot.X_WB.linear() =
          Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    }
    cell.robots.push_back(std::move(robot));
  }
  cell.checking.time_step = 10ms;
  cell.scheduling.on_idle_blocker = OnIdleBlocker::report;
  return cell;
}

// Returns a quintic motion of one slider from rest to rest.
inline JobRequest slide(const std::string& arm, double from_m, double to_m, double duration_s,
                        std::string key = "") {
  JobRequest request{.key = std::move(key), .name = "", .trajectory = {}};
  request.trajectory.joint_names = {arm + "_slide"};
  request.trajectory.points = {{{from_m}, {0.0}, {0.0}, 0.0}, {{to_m}, {0.0}, {0.0}, duration_s}};
  return request;
}

// Returns a job with a goal.
inline JobRequest move_to(const std::string& arm, double to_m, std::string key) {
  JobRequest request{.key = std::move(key), .name = "", .trajectory = {}};
  request.arm = arm;
  request.move_to = PlanGoal{.joints = std::vector{to_m}, .named = {}, .pose = {}};
  return request;
}

// Records all events. Fails the test if the guard refuses anything, unless may_refuse is set.
struct Log final : Observer {
  void on_event(const Event& event) override {
    events.push_back(event);
    const auto* guard = std::get_if<GuardEvent>(&event.body);
    if (guard == nullptr || may_refuse) return;
    ADD_FAILURE() << "the guard refused (" << to_string(guard->refusal.why) << ") " << guard->job
                  << " on " << guard->arm << ", beside " << guard->other_arm << " on "
                  << guard->other_job << ": " << to_seconds(guard->refusal.asked.to_a)
                  << " s beside " << to_seconds(guard->refusal.asked.from_b) << " to "
                  << to_seconds(guard->refusal.asked.to_b) << " s";
  }
  void on_tick(TimePoint, const Configuration& measured) override {
    if (first.size() == 0) first = measured;
    last = measured;
    if (measured.size() == 2) {
      closest_m = std::min(closest_m, measured.norm() - 0.2);  // of the crossing's two balls
    }
  }
  void on_state(const StateFrame&) override {}

  std::vector<Event> events;
  Configuration first, last;
  double closest_m = 1e9;
  bool may_refuse = false;  // set if the guard is expected to refuse
};

// The crossing cell on simulated time.
struct Crossing {
  explicit Crossing(CellDescription description = crossing_description(),
                    const std::string& policy = "timed_discrete",
                    ControllerTypes controllers = {}) {
    auto built = build_cell(description);
    if (!built) throw std::runtime_error(built.error().front().detail);
    ExecutiveOptions options{.policy = policy, .controllers = std::move(controllers)};
    auto created = Simulation::create(*built, std::move(options), log);
    if (!created) throw std::runtime_error(created.error().front().detail);
    simulation = std::move(*created);
    simulation->tick();
  }

  JobView submit(JobRequest request) {
    auto view = simulation->executive().submit(std::move(request));
    if (!view) throw std::runtime_error(view.error().front().detail);
    return *view;
  }
  JobView job(const std::string& key) const { return *simulation->executive().job(key); }
  void run_until(TimePoint time) { simulation->run_until(time); }
  // Runs until every job has ended; fails the test at `limit`.
  void run_to_the_end(TimePoint limit = at(60s)) {
    while (!simulation->executive().all_ended() && simulation->now() < limit) simulation->tick();
    EXPECT_TRUE(simulation->executive().all_ended()) << "jobs hang";
  }

  Log log;
  std::unique_ptr<Simulation> simulation;
};

}  // namespace armloom
