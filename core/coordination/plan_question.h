#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "core/base/ids.h"
#include "core/base/time.h"
#include "core/model/cell.h"
#include "core/trajectory/trajectory.h"

namespace armloom {

struct LinkTarget {
  LinkId link;
  Eigen::Isometry3d X_WL;  // in the world (m)
};
// Goal: the nearest configuration found that is clear of this motion from `progress` on.
struct ClearOf {
  TrajectoryPtr motion;
  Duration progress{};
};
struct MotionGoal {
  ArmId arm;
  // Joint positions in the arm's order (rad, m), a link pose, or a place out of another motion's
  // path.
  std::variant<Eigen::VectorXd, LinkTarget, ClearOf> to;
  double speed = 1.0;     // in (0, 1]: scales velocities; accelerations are scaled by its square
  bool straight = false;  // LinkTarget: along a straight line in the world (tool_line.h)
};

// Asks for a motion to a goal. Plain data, safe to pass to another thread.
struct PlanQuestion {
  MotionGoal goal;
  Configuration at;  // positions of all joints of the cell; the arm starts at its own
  // Arms that will move away from their present position. The planner first looks for a path past
  // these arms, except those that are in the way at the arm's start or goal. If there is no such
  // path, it ignores all these arms.
  std::vector<ArmId> may_move = {};
  bool has_no_way_past = false;  // no path exists past `may_move`: ignore them at once
  std::uint64_t seed = 1;
  std::optional<std::uint64_t> budget = {};  // evaluations per try; nullopt for the default
};

}  // namespace armloom
