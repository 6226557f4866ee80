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

// Where one arm is to be, and how fast it goes there. Plain data.
struct LinkTarget {
  LinkId link;
  Eigen::Isometry3d X_WL;  // in the world (m)
};
// Wherever the arm stands clear of what remains of this motion of others: the nearest such place
// that is found.
struct ClearOf {
  TrajectoryPtr motion;
  Duration progress{};
};
struct MotionGoal {
  ArmId arm;
  // Of the arm's joints, in its order (rad, m); or of one of its links; or out of the way.
  std::variant<Eigen::VectorXd, LinkTarget, ClearOf> to;
  double speed = 1.0;     // in (0, 1]: as if all were stretched in time
  bool straight = false;  // of a link: along a straight line in the world (tool_line.h)
};

// "How does the arm get there?" Plain data: complete, self-contained, safe to hand to another
// thread.
struct PlanQuestion {
  MotionGoal goal;
  Configuration at;  // where every joint stands: the arm's own are the start
  // Arms that do not rest there for good: a way past them is looked for first, past all but those
  // that stand where the arm sets out or is to go; where there is none, one as if they were gone.
  std::vector<ArmId> may_move = {};
  bool has_no_way_past = false;  // that is known already of these: it is looked for as if gone
  std::uint64_t seed = 1;
  std::optional<std::uint64_t> budget = {};  // evaluations of a try; else the planner's own
};

}  // namespace armloom
