#pragma once

#include <vector>

#include "core/collision/scene/planning_scene.h"
#include "core/collision/state/clearance_query.h"
#include "core/model/cell.h"
#include "core/trajectory/trajectory.h"

namespace armloom::experiments {

// Checks where an arm may move and rest so that the whole set of jobs stays solvable under every
// policy: with all arms at any of their rests, any job can run. Use one object per thread.
class OpenPlaces {
 public:
  // Throws std::runtime_error with the problems of PlanningScene::build.
  explicit OpenPlaces(CellPtr cell);

  // Returns true if the motion keeps kMargin_m more than the cell's clearance to everything, and
  // kSelfMargin_m more than the self clearance. Sampled every 10 ms with all other arms at home.
  [[nodiscard]] bool clear_alone(const Trajectory& motion);
  // Like clear_alone(), with `arm` resting at `q` (rad, as Arm::joints) and the other arms at home.
  [[nodiscard]] bool clear_beside(const Trajectory& motion, ArmId arm, const Eigen::VectorXd& q);

  // Covers what the certified check adds: tracking error times levers, and motion between two
  // samples.
  static constexpr double kMargin_m = 0.012;
  static constexpr double kSelfMargin_m = 0.005;

 private:
  [[nodiscard]] bool clear(const Trajectory& motion, const Configuration& rest);

  CellPtr cell_;
  ClearanceQuery check_;
};

// Writes the motion's joint positions at `time` into q.
void place(const Trajectory& motion, Duration time, Configuration& q);

}  // namespace armloom::experiments
