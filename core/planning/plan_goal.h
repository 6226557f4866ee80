#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "core/coordination/plan_question.h"

namespace armloom {

// The goal of an arm, from a client: exactly one of the three.
struct PlanPose {
  // With or without the robot's prefix; by default the link of the arm's last joint.
  std::optional<std::string> link;
  Eigen::Isometry3d X_WL = Eigen::Isometry3d::Identity();  // in the world (m)
};
struct PlanGoal {
  std::optional<std::vector<double>> joints;  // rad or m, in the order of the arm's group
  std::optional<std::string> named;           // a named state of the SRDF, or "home"
  std::optional<PlanPose> pose;
  bool cartesian = false;  // with a pose: the link moves in a straight line
};

// One arm, or several candidates of which one moves; exactly one member is given.
struct GoalArms {
  std::string arm;
  std::vector<std::string> arms;
};

// Problems have the pointer "".
[[nodiscard]] Result<ArmId> find_arm(const Cell& cell, const std::string& name);
// Converts the goal to the cell's terms, at the cell's speed. Problems (unknown state or link,
// wrong number of joints) point below the goal ("/named"). The planner checks limits.
[[nodiscard]] Result<MotionGoal> goal_of(const Cell& cell, ArmId arm, const PlanGoal& said);
// Converts the goal for each arm. Problems are those of goal_of() below `place` ("/move_to"), and
// those of arms at "/arm", "/arms" or "/arms/1": none, unknown, named twice, or one of several that
// does not move the link (for a single arm at "/pose/link").
[[nodiscard]] Result<std::vector<MotionGoal>> goals_of(const Cell& cell, const GoalArms& who,
                                                       const PlanGoal& said,
                                                       const std::string& place);
// Returns the positions of a joint goal or named state; a pose is a problem.
[[nodiscard]] Result<Eigen::VectorXd> joints_of(const Cell& cell, ArmId arm, const PlanGoal& said);

}  // namespace armloom
