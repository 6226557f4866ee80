// Goals that jobs bring instead of a trajectory.
#include <cstdio>
#include <utility>

#include "core/base/add_below.h"
#include "core/executive/job_intake.h"
#include "core/trajectory/joint_line.h"
#include "core/trajectory/set_joints.h"

namespace armloom {
namespace {

// Of a goal that says where each joint is to be.
void find_outside_limits(const Cell& cell, const MotionGoal& goal, Problems& problems) {
  const auto* q = std::get_if<Eigen::VectorXd>(&goal.to);
  if (q == nullptr) return;
  const auto& joints = cell.arm(goal.arm).joints;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const Joint& joint = cell.joint(joints[j]);
    const double position = (*q)[static_cast<Eigen::Index>(j)];
    if (is_within_limits(joint, position)) continue;
    char text[160];
    std::snprintf(text, sizeof text, "%s at %.6g is outside its limits %.6g to %.6g",
                  joint.name.c_str(), position, joint.lower, joint.upper);
    problems.push_back({ProblemKind::invalid, "limit-exceeded",
                        "/move_to/joints/" + std::to_string(j), text, position});
  }
}

// How long it may take: the straight line; of a pose, whose joint positions are not known yet, the
// way home.
TrajectoryPtr estimate(const Cell& cell, const MotionGoal& goal, const Configuration& rest) {
  const Arm& arm = cell.arm(goal.arm);
  const auto* q = std::get_if<Eigen::VectorXd>(&goal.to);
  const Eigen::VectorXd& to = q != nullptr ? *q : arm.home;
  auto line = joint_line(cell, arm.joints, joints_of(rest, arm.joints), to);
  if (!line) line = joint_line(cell, arm.joints, to, to);  // it stands outside its limits
  return *line;
}

}  // namespace

std::optional<MotionGoal> JobIntake::read_goal(const JobRequest& request,
                                               Problems& problems) const {
  if (request.order == JobOrder::any) {
    problems.push_back({ProblemKind::invalid, "not-served", "/order",
                        "a goal's job keeps its place: whether it ends where it begins is not "
                        "known before it is planned",
                        to_string(request.order)});
  }
  auto arm = find_arm(*cell_, request.arm);
  if (!arm) add_below("/arm", std::move(arm.error()), problems);
  if (!arm) return std::nullopt;
  auto goal = goal_of(*cell_, *arm, *request.move_to);
  if (!goal) add_below("/move_to", std::move(goal.error()), problems);
  if (!goal) return std::nullopt;
  goal->speed = request.speed;
  find_outside_limits(*cell_, *goal, problems);
  return *std::move(goal);
}

TrajectoryPtr JobIntake::estimate_for(const MotionGoal& goal, Ahead& ahead) const {
  // It goes there from wherever the arm stands: nobody has to go back first.
  ahead.ways_back.erase(goal.arm);
  std::erase(ahead.open, goal.arm);
  if (std::holds_alternative<LinkTarget>(goal.to)) ahead.open.push_back(goal.arm);
  return estimate(*cell_, goal, ahead.rest);
}

}  // namespace armloom
