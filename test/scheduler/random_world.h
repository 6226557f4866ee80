#pragma once

#include <functional>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "test/scheduler/ideal_arms.h"

namespace armloom {

struct Disturbances {
  bool delays = false;
  bool pauses = false;  // all arms are stopped and resumed
  bool stops = false;   // single arms are stopped and resumed
  bool cancels = false;
  bool scenes = false;
  bool parks = false;
  bool amends = false;   // changed priorities and timeouts
  bool choices = false;  // some jobs may be done in any order, or by any of several arms
  bool goals = false;    // some jobs have goals, for one or any arm, or a move-to-start
  bool crowds = false;   // jobs have any goals: some may be impossible
};

// A random workload for two to four one-joint arms, which move alone and in teams. Without the
// disturbances all jobs can be done in order of submission. Deterministic for equal arguments.
class World {
 public:
  World(std::uint64_t seed, const std::string& policy, Disturbances disturbances);

  // Runs until nothing happens anymore; calls `look` at many instants.
  void run(const std::function<void()>& look = [] {});

  // Draws a job that is free after all accepted jobs have ended, or with `any` an arbitrary job;
  // nullopt if none was found.
  [[nodiscard]] std::optional<Submit> draw(bool any = false);
  JobId submit(Submit job);

  [[nodiscard]] IdealArms& bench() { return bench_; }
  std::vector<JobId> jobs;

 private:
  CellPtr cell();
  [[nodiscard]] std::optional<Submit> draw_visit(const Configuration& rest, bool any);
  [[nodiscard]] std::optional<Submit> draw_goal(const Configuration& rest);
  double place() { return 0.01 * static_cast<double>(random_() % 101); }
  Duration up_to(Duration most);
  std::vector<Crossing> table();
  Habits habits();
  void disturb();
  [[nodiscard]] std::vector<ArmId> all() const;
  void stop(const std::vector<ArmId>& arms);
  void resume();
  void change_scene(std::vector<Object> objects);

  std::mt19937_64 random_;
  Disturbances disturbances_;
  std::size_t arms_;
  CellPtr cell_;
  IdealArms bench_;
  std::set<ArmId> stopped_;
};

}  // namespace armloom
