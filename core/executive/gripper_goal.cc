#include "core/executive/gripper_goal.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include "core/planning/plan_goal.h"
#include "core/trajectory/joint_line.h"
#include "core/trajectory/set_joints.h"

namespace armloom {
namespace {

using Positions = std::map<JointId, double>;

std::string names_of(const Cell& cell, const std::vector<JointId>& joints) {
  std::string names;
  for (const JointId joint : joints) names += (names.empty() ? "" : ", ") + cell.joint(joint).name;
  return names.empty() ? "none" : names;
}

std::string why_not_moved(const Cell& cell, const Arm& arm, const std::string& name) {
  const Robot& robot = cell.robots[arm.robot.index()];
  for (const std::string& known : {name, robot.prefix + name}) {
    const auto still = robot.joints_without_value.find(known);
    if (still == robot.joints_without_value.end()) continue;
    return known + " " + still->second + ", and has no value of its own: leave it out";
  }
  return name + " is no gripper joint of arm " + arm.name +
         " (its gripper joints: " + names_of(cell, arm.gripper_joints) +
         "); the arm's own joints are given as a list in the order of its group";
}

Result<Positions> positions_of(const JobRequest& request, const Cell& cell, const Arm& arm) {
  if (request.move_to->named) return arm.gripper_states.at(*request.move_to->named);
  Positions positions;
  Problems problems;
  for (const auto& [name, position] : request.move_to->gripper) {
    const std::string place = "/move_to/joints/" + name;
    const auto joint = find_joint(name, arm.name, cell);
    if (!joint || std::ranges::count(arm.gripper_joints, *joint) == 0) {
      problems.push_back(
          {ProblemKind::invalid, "unknown-joint", place, why_not_moved(cell, arm, name), name});
      continue;
    }
    const Joint& known = cell.joint(*joint);
    if (!is_within_limits(known, position)) {
      char text[160];
      std::snprintf(text, sizeof text, "%s at %.6g is outside its limits %.6g to %.6g",
                    known.name.c_str(), position, known.lower, known.upper);
      problems.push_back({ProblemKind::invalid, "limit-exceeded", place, text, position});
    }
    positions[*joint] = position;
  }
  if (!problems.empty()) return failure(std::move(problems));
  return positions;
}

}  // namespace

bool moves_gripper_only(const JobRequest& request, const Cell& cell) {
  if (!request.move_to || !request.arms.empty()) return false;
  const PlanGoal& goal = *request.move_to;
  if (!goal.gripper.empty()) return true;
  const auto arm = cell.find_arm(request.arm);
  if (!goal.named || !arm || *goal.named == "home") return false;
  return !cell.arm(*arm).named_states.contains(*goal.named) &&
         cell.arm(*arm).gripper_states.contains(*goal.named);
}

Result<TrajectoryPtr> gripper_motion(const JobRequest& request, const Cell& cell,
                                     const Configuration& rest) {
  if (request.arm.empty()) {
    return failure(Problem{ProblemKind::invalid,
                           "no-arm",
                           "/arm",
                           "no arm is given: name the arm that has the gripper (\"arm\")",
                           {}});
  }
  auto id = find_arm(cell, request.arm);
  if (!id) {
    for (Problem& problem : id.error()) problem.pointer = "/arm";
    return failure(std::move(id.error()));
  }
  const Arm& arm = cell.arm(*id);
  const auto positions = positions_of(request, cell, arm);
  if (!positions) return failure(positions.error());
  std::vector<JointId> joints = arm.joints;
  for (const auto& [joint, position] : *positions) joints.push_back(joint);
  const Eigen::VectorXd from = joints_of(rest, joints);
  Eigen::VectorXd to = from;
  Eigen::Index row = static_cast<Eigen::Index>(arm.joints.size());
  for (const auto& [joint, position] : *positions) to[row++] = position;
  return joint_line(cell, joints, from, to, request.speed);
}

Result<std::map<std::string, double>> joints_at_width(const Cell& cell,
                                                      const GripperStepRequest& gripper) {
  const auto id = cell.find_arm(gripper.arm);
  if (!id) {
    return failure(Problem{ProblemKind::invalid, "unknown-arm", "/gripper/arm",
                           "the cell has no arm \"" + gripper.arm + "\"", gripper.arm});
  }
  const Arm& arm = cell.arm(*id);
  double per_joint = 0.0, offset = 0.0;
  bool turns = false;
  for (const Link& link : cell.links) {
    if (!link.driver || std::ranges::count(arm.gripper_joints, *link.driver) == 0) continue;
    turns = turns || link.motion != JointKind::prismatic;
    per_joint += std::abs(link.multiplier);
    offset += link.offset;
  }
  if (turns || per_joint == 0.0) {
    return failure(Problem{
        ProblemKind::invalid, "no-width", "/gripper/width_m",
        "arm " + arm.name + (turns ? " has a gripper whose fingers turn" : " has no gripper") +
            ": move gripper joints by \"move_to\": {\"joints\": {NAME: position}}",
        gripper.width_m});
  }
  const double position = (gripper.width_m - offset) / per_joint;
  std::map<std::string, double> positions;
  for (const JointId joint : arm.gripper_joints) {
    const Joint& known = cell.joint(joint);
    if (!is_within_limits(known, position)) {
      char text[160];
      std::snprintf(text, sizeof text, "a width of %.6g m is outside %.6g to %.6g m",
                    gripper.width_m, known.lower * per_joint + offset,
                    known.upper * per_joint + offset);
      return failure(Problem{ProblemKind::invalid, "limit-exceeded", "/gripper/width_m", text,
                             gripper.width_m});
    }
    positions[known.name] = position;
  }
  return positions;
}

Result<TrajectoryPtr> gripper_motion(const GripperStepRequest& gripper, const Cell& cell,
                                     const Configuration& rest) {
  auto positions = joints_at_width(cell, gripper);
  if (!positions) return failure(std::move(positions.error()));
  JobRequest request;
  request.arm = gripper.arm;
  request.move_to = PlanGoal{.joints = {}, .named = {}, .pose = {}, .gripper = *positions};
  return gripper_motion(request, cell, rest);
}

}  // namespace armloom
