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
// Goal: the nearest configuration found that is clear of the rest of this motion.
struct ClearOf {
  TrajectoryPtr motion;
  Duration progress{};
};
struct MotionGoal {
  ArmId arm;
  // Joint positions in the arm's order (rad, m), a link pose, or out of another motion's path.
  std::variant<Eigen::VectorXd, LinkTarget, ClearOf> to;
  double speed = 1.0;     // in (0, 1]: scales velocity, and acceleration by its square
  bool straight = false;  // LinkTarget: along a straight line in the world (tool_line.h)
};

// Asks for a motion to a goal. Plain data, safe to pass to another thread.
struct PlanQuestion {
  MotionGoal goal;
  Configuration at;  // all joints of the cell; the arm's own are the start
  // Arms that will move away from their present position. The planner first looks for a path
  // past them, except those at the arm's start or goal. If there is none, it ignores them all.
  std::vector<ArmId> may_move = {};
  bool has_no_way_past = false;  // no path exists past `may_move`: ignore them at once
  std::uint64_t seed = 1;
  std::optional<std::uint64_t> budget = {};  // evaluations per try; nullopt for the default
};

}  // namespace armloom
