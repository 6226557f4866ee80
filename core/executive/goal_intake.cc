// Reads goals of jobs without a trajectory.
#include <cstdio>
#include <utility>

#include "core/base/add_below.h"
#include "core/executive/job_intake.h"
#include "core/trajectory/joint_line.h"
#include "core/trajectory/set_joints.h"

namespace armloom {
namespace {

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

// Estimates the motion by the straight line in joint space at the goal's speed. The joint positions
// of a pose are not known yet; for a pose, the line leads home.
TrajectoryPtr estimate(const Cell& cell, const MotionGoal& goal, const Configuration& rest) {
  const Arm& arm = cell.arm(goal.arm);
  const auto* q = std::get_if<Eigen::VectorXd>(&goal.to);
  const Eigen::VectorXd& to = q != nullptr ? *q : arm.home;
  auto line = joint_line(cell, arm.joints, joints_of(rest, arm.joints), to, goal.speed);
  if (!line)
    line = joint_line(cell, arm.joints, to, to, goal.speed);  // it stands outside its limits
  return *line;
}

}  // namespace

std::vector<MotionGoal> JobIntake::read_goals(const JobRequest& request, Problems& problems) const {
  if (request.terms.reorderable) {
    problems.push_back({ProblemKind::invalid, "not-served", "/reorderable",
                        "a job with a goal cannot be reordered, because its end is not known "
                        "before it is planned: leave out \"reorderable\"",
                        "true"});
  }
  auto goals = goals_of(*cell_, {request.arm, request.arms}, *request.move_to, "/move_to");
  if (!goals) {
    add_below("", std::move(goals.error()), problems);
    return {};
  }
  for (MotionGoal& goal : *goals) {
    goal.speed = request.speed.value_or(goal.speed);
    find_outside_limits(*cell_, goal, problems);
  }
  return *std::move(goals);
}

std::vector<TrajectoryPtr> JobIntake::estimates_for(const std::vector<MotionGoal>& goals,
                                                    Ahead& ahead) const {
  std::vector<TrajectoryPtr> estimates;
  for (const MotionGoal& goal : goals) {
    std::erase(ahead.open, goal.arm);
    const bool is_open = goals.size() > 1 || std::holds_alternative<LinkTarget>(goal.to);
    if (is_open) ahead.open.push_back(goal.arm);
    estimates.push_back(estimate(*cell_, goal, ahead.rest));
    (void)ahead.ways_back.take(*cell_, *estimates.back(), ahead.rest);
  }
  return estimates;
}

}  // namespace armloom
