#pragma once

#include <cstddef>
#include <vector>

#include "core/collision/scene/planning_scene.h"
#include "core/collision/state/clearance_query.h"
#include "core/model/kinematics.h"
#include "test/bench/moveit_way.h"

namespace armloom::bench {

// Returns the scene in which each Panda's hand holds a box of 4 x 4 x 8 cm.
[[nodiscard]] PlanningScenePtr holding_boxes(const PlanningScenePtr& scene);

// Exact shapes without the engine's filter: the reference of the benchmarks.
struct ExactScene {
  PlanningScenePtr scene;
  LinkPoses X_WL;  // scratch

  explicit ExactScene(const CellPtr& cell);
  [[nodiscard]] const Cell& cell() const { return scene->cell(); }

  // Returns the exact distance between different arms, at most horizon_m.
  [[nodiscard]] double between_arms(const Configuration& q, double horizon_m);
  // Returns the exact distance of arms to the scene, at most horizon_m.
  [[nodiscard]] double to_scene(const Configuration& q, double horizon_m);
  // Returns true if two links of one arm are closer than clearance_m * self_clearance_m /
  // Cell::clearance_m.
  [[nodiscard]] bool self_too_close(const Configuration& q, double clearance_m);
  [[nodiscard]] bool self_too_close(const Configuration& q) {
    return self_too_close(q, cell().clearances.clearance_m);
  }
  // Returns true if any checked pair touches, own links included.
  [[nodiscard]] bool in_contact(const Configuration& q);
  // Returns true if the arm is closer than clearance_m to anything, or too close to itself (see
  // self_too_close()).
  [[nodiscard]] bool too_close(const Configuration& q, ArmId arm, double clearance_m);
};

// Decides which states and motions become workloads. Exact shapes decide, and states in which only
// the baseline's meshes touch are left out. The baseline's convex link meshes fill the hollows of a
// folded arm, and a check that ends at such a contact would measure nothing.
struct Referees {
  ExactScene exact;
  MoveItWay moveit;

  explicit Referees(const CellPtr& cell) : exact(cell), moveit(cell) {}
  // Returns true if the baseline reports a contact of one of the arms while all others are at home.
  [[nodiscard]] bool baseline_sees_one_arm_touch(const Configuration& q);
};

// Combined states of two Pandas, sorted by the exact distance d between the arms. Except in
// `touching`, each arm keeps self_clearance_m from itself, also for the baseline.
struct StateClasses {
  std::vector<Configuration> apart;     // d and the distance to the table above 0.10 m
  std::vector<Configuration> near;      // 3 mm <= d <= 50 mm, the table at least 3 mm away
  std::vector<Configuration> touching;  // d <= 0: the arms touch, possibly among other contacts
};
// Deterministic for `count` and the standard library.
[[nodiscard]] StateClasses classed_states(Referees& referees, std::size_t count);

// Returns states in which nothing is closer than 3 mm (links of one arm: self_clearance_m). Every
// arm is placed three times, each time at random until it is clear.
[[nodiscard]] std::vector<Configuration> free_states(Referees& referees, std::size_t count);

}  // namespace armloom::bench
