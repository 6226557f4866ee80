#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "core/coordination/plan_question.h"

namespace armloom {

// Where an arm is to be, as people say it: exactly one of the three.
struct PlanPose {
  // With or without the robot's prefix; absent: that of the arm's last joint.
  std::optional<std::string> link;
  Eigen::Isometry3d X_WL = Eigen::Isometry3d::Identity();  // in the world (m)
};
struct PlanGoal {
  std::optional<std::vector<double>> joints;  // rad or m, in the order of the arm's group
  std::optional<std::string> named;           // a named state of the SRDF, or "home"
  std::optional<PlanPose> pose;
  bool cartesian = false;  // with a pose: the link goes there in a straight line
};

// Who is to go there: one arm, or whichever of several; exactly one of the two is given.
struct GoalArms {
  std::string arm;
  std::vector<std::string> arms;
};

// Problems: pointer "".
[[nodiscard]] Result<ArmId> find_arm(const Cell& cell, const std::string& name);
// The same in the cell's terms. Problems: a state or link that there is not, another number of
// joints; pointers are below the goal ("/named"). Limits are the planner's to look at. As fast as
// the cell has it.
[[nodiscard]] Result<MotionGoal> goal_of(const Cell& cell, ArmId arm, const PlanGoal& said);
// For each of the arms. Problems: as above, those of the goal below `place` ("/move_to"), those of
// arms at "/arm", "/arms" or "/arms/1": none named, unknown, named twice, one of several that does
// not move the link (of a single arm the link is at fault: "/pose/link").
[[nodiscard]] Result<std::vector<MotionGoal>> goals_of(const Cell& cell, const GoalArms& who,
                                                       const PlanGoal& said,
                                                       const std::string& place);
// Of joints or a named state; a pose does not say where each joint stands.
[[nodiscard]] Result<Eigen::VectorXd> joints_of(const Cell& cell, ArmId arm, const PlanGoal& said);

}  // namespace armloom
