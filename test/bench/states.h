#pragma once

#include <cstddef>
#include <vector>

#include "core/collision/scene/planning_scene.h"
#include "core/collision/state/clearance_query.h"
#include "core/model/kinematics.h"
#include "test/bench/moveit_way.h"

namespace armloom::bench {

// A scene looked at with exact shapes, without the engine's filter: the truth of the benchmarks.
struct ExactScene {
  PlanningScenePtr scene;
  LinkPoses X_WL;  // scratch

  explicit ExactScene(const CellPtr& cell);
  [[nodiscard]] const Cell& cell() const { return scene->cell(); }

  // The exact distance between different arms; horizon_m where they are farther apart.
  [[nodiscard]] double between_arms(const Configuration& q, double horizon_m);
  // Of any arm to objects and other robots' static links, the same way.
  [[nodiscard]] double to_scene(const Configuration& q, double horizon_m);
  // Whether some arm's own links are closer than they must be when arms keep clearance_m from each
  // other: the share self_clearance_m / Cell::clearance_m of it.
  [[nodiscard]] bool self_too_close(const Configuration& q, double clearance_m);
  [[nodiscard]] bool self_too_close(const Configuration& q) {
    return self_too_close(q, cell().clearances.clearance_m);
  }
  // Whether anything that the scene looks at touches, an arm's own links included.
  [[nodiscard]] bool in_contact(const Configuration& q);
  // Whether the arm is closer than that to anything, or to itself than its share of that.
  [[nodiscard]] bool too_close(const Configuration& q, ArmId arm, double clearance_m);
};

// Who decides what a workload is: the exact shapes, and whether the baseline would see its own
// meshes touch where the shapes do not. Its convex link meshes fill the hollows of a folded arm; a
// check that ends at such a contact would be no measure, so these states are no workload.
struct Referees {
  ExactScene exact;
  MoveItWay moveit;

  explicit Referees(const CellPtr& cell) : exact(cell), moveit(cell) {}
  // Whether the baseline reports one arm against itself or the scene, all others at home.
  [[nodiscard]] bool baseline_sees_one_arm_touch(const Configuration& q);
};

// Combined states of two Pandas, uniform within the limits, in classes by the exact distance d
// between the arms. In all but `touching` each arm keeps self_clearance_m from itself, and the
// baseline sees no arm touch itself.
struct StateClasses {
  std::vector<Configuration> apart;     // d and the distance to the table above 0.10 m
  std::vector<Configuration> near;      // 3 mm <= d <= 50 mm, the table at least 3 mm away
  std::vector<Configuration> touching;  // d <= 0: the arms touch, whatever else does
};
// The same states for the same count, on every machine with one standard library.
[[nodiscard]] StateClasses classed_states(Referees& referees, std::size_t count);

// States in which nothing is closer than 3 mm (an arm to itself: self_clearance_m), for any number
// of arms: arm after arm is put anywhere until it is clear of all others, three times around.
[[nodiscard]] std::vector<Configuration> free_states(Referees& referees, std::size_t count);

}  // namespace armloom::bench
