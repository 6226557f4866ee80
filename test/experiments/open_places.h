#pragma once

#include <vector>

#include "core/collision/scene/planning_scene.h"
#include "core/collision/state/clearance_query.h"
#include "core/model/cell.h"
#include "core/trajectory/trajectory.h"

namespace armloom::experiments {

// Where an arm may go and rest so that the whole set of jobs stays solvable under every policy:
// with all arms at rest, wherever they are told to rest, any job can run. One thread each.
class OpenPlaces {
 public:
  // Problems as PlanningScene::build; throws std::runtime_error with them.
  explicit OpenPlaces(CellPtr cell);

  // Whether the motion, seen every 10 ms with all other arms at home, keeps kMargin_m more than the
  // cell's clearance to everything, and more than its own to itself.
  [[nodiscard]] bool clear_alone(const Trajectory& motion);
  // Whether it does so with `arm` resting at `q` (rad, as Arm::joints) and the others at home.
  [[nodiscard]] bool clear_beside(const Trajectory& motion, ArmId arm, const Eigen::VectorXd& q);

  // Covers what the certified check adds: tracking error times the levers, and what lies between
  // two samples.
  static constexpr double kMargin_m = 0.012;
  static constexpr double kSelfMargin_m = 0.005;

 private:
  [[nodiscard]] bool clear(const Trajectory& motion, const Configuration& rest);

  CellPtr cell_;
  ClearanceQuery check_;
};

// Puts the motion's joints, `time` on its way, into q.
void place(const Trajectory& motion, Duration time, Configuration& q);

}  // namespace armloom::experiments
