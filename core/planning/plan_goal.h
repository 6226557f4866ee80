#pragma once

#include <Eigen/Geometry>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "core/coordination/plan_question.h"

namespace armloom {

// A client's goal for an arm. In PlanGoal exactly one of `joints`, `gripper`, `named` and `pose` is
// given.
struct PlanPose {
  // Name of the link, with or without the robot's prefix; by default the link of the arm's last
  // joint.
  std::optional<std::string> link;
  Eigen::Isometry3d X_WL = Eigen::Isometry3d::Identity();  // in the world (m)
};
struct PlanGoal {
  std::optional<std::vector<double>> joints;  // rad or m, in the order of the arm's group
  std::optional<std::string> named;           // a named state of the SRDF, or "home"
  std::optional<PlanPose> pose;
  bool cartesian = false;  // with a pose: the link moves in a straight line
  // Positions of gripper joints by name, with or without the robot's prefix; rad or m. The arm
  // stays. The planner refuses them: see core/executive/gripper_goal.h.
  std::map<std::string, double> gripper = {};
};

// One arm, or several candidates of which one moves; exactly one member is given.
struct GoalArms {
  std::string arm;
  std::vector<std::string> arms;
};

// Returns the arm of that name. The place of a problem is "".
[[nodiscard]] Result<ArmId> find_arm(const Cell& cell, const std::string& name);
// Converts the goal to ids of the cell, with the cell's default speed. The place of a problem is
// relative to the goal ("/named"): unknown state or link, wrong number of joints. Joint limits are
// not checked here, but by the planner.
[[nodiscard]] Result<MotionGoal> goal_of(const Cell& cell, ArmId arm, const PlanGoal& said);
// Converts the goal for each arm. Places of problems:
// - below `place` ("/move_to"): problems of goal_of(), and "/pose/link" if a single arm does not
//   move the link;
// - "/arm", "/arms" or "/arms/1": no arm is given, an arm is unknown or named twice, or one of
//   several arms does not move the link.
[[nodiscard]] Result<std::vector<MotionGoal>> goals_of(const Cell& cell, const GoalArms& who,
                                                       const PlanGoal& said,
                                                       const std::string& place);
// Returns the positions of a joint goal or named state; a pose is a problem.
[[nodiscard]] Result<Eigen::VectorXd> joints_of(const Cell& cell, ArmId arm, const PlanGoal& said);

}  // namespace armloom
