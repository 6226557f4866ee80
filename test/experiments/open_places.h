#pragma once

#include <vector>

#include "core/collision/scene/planning_scene.h"
#include "core/collision/state/clearance_query.h"
#include "core/model/cell.h"
#include "core/trajectory/trajectory.h"

namespace armloom::experiments {

// Checks that jobs stay solvable under every policy: any job can run while all other arms are at
// any of their rests. One object per thread.
class OpenPlaces {
 public:
  // Throws std::runtime_error with the problems of PlanningScene::build.
  explicit OpenPlaces(CellPtr cell);

  // Returns true if the motion keeps kMargin_m more than the clearance, and kSelfMargin_m more than
  // the self clearance (every 10 ms, other arms at home).
  [[nodiscard]] bool clear_alone(const Trajectory& motion);
  // Checks the same with `arm` resting at `q` (rad, as Arm::joints).
  [[nodiscard]] bool clear_beside(const Trajectory& motion, ArmId arm, const Eigen::VectorXd& q);

  // The margin covers the effect of tracking errors at the tool, and motion between samples.
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
