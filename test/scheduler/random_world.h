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
  bool pauses = false;  // all arms are stopped, and resumed
  bool stops = false;   // single ones are
  bool cancels = false;
  bool scenes = false;
  bool parks = false;
  bool amends = false;   // other priorities, other timeouts
  bool choices = false;  // some jobs may be done in any order, or by any of several arms
  bool goals = false;    // some say where to go, by one or any arm, or are brought to their start
  bool crowds = false;   // jobs go wherever they like: nothing says that all can be done
};

// A random workload of two to four arms of one joint that share places by a table, alone and in
// teams: jobs that can all be done one after the other in the order of submission, and what
// disturbs them. The same for the same arguments.
class World {
 public:
  World(std::uint64_t seed, const std::string& policy, Disturbances disturbances);

  // From the first job until nothing happens any more. `look` is called at many an instant.
  void run(const std::function<void()>& look = [] {});

  // A job for the present instant that finds its way when all that are accepted have ended, or,
  // with `any`, wherever it goes. Nothing: none was found.
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
