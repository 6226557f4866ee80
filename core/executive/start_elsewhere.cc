#include "core/executive/start_elsewhere.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "core/base/rounding_noise.h"
#include "core/base/whole_turns.h"
#include "core/trajectory/joints_elsewhere.h"

namespace armloom {

namespace {

// Returns the multiple of 2 pi that brings the joint's start to `stands`; 0 if there is none.
double turns_to(const Joint& joint, double begins, double stands, double tolerance) {
  if (joint.kind != JointKind::continuous || joint.has_lower() || joint.has_upper()) return 0.0;
  constexpr double kTurn_rad = 2.0 * std::numbers::pi;
  const double turns_rad = std::round((stands - begins) / kTurn_rad) * kTurn_rad;
  return std::abs(begins + turns_rad - stands) <= tolerance ? turns_rad : 0.0;
}

}  // namespace

TrajectoryPtr with_whole_turns(const Cell& cell, TrajectoryPtr motion, const Configuration& rest) {
  Eigen::VectorXd turns = Eigen::VectorXd::Zero(motion->start().size());
  for (std::size_t j = 0; j < motion->joints().size(); ++j) {
    const JointId joint = motion->joints()[j];
    turns[static_cast<Eigen::Index>(j)] = turns_to(
        cell.joint(joint), motion->start()[static_cast<Eigen::Index>(j)],
        rest[static_cast<Eigen::Index>(joint.index())], cell.execution.start_tolerance_rad);
  }
  if (turns.isZero(0.0)) return motion;
  std::vector<Segment> segments = motion->segments();
  for (Segment& segment : segments) segment.coefficients.col(0) += turns;
  return std::make_shared<const Trajectory>(motion->joints(), motion->arms(), std::move(segments),
                                            motion->timed_here());
}

namespace {

bool is_gripper_joint(const Cell& cell, JointId id) {
  const std::optional<ArmId> arm = cell.joint(id).arm;
  return arm && std::ranges::count(cell.arm(*arm).gripper_joints, id) > 0;
}

Problem problem_of(const Cell& cell, const JointElsewhere& elsewhere) {
  const Joint& joint = cell.joint(elsewhere.joint);
  const double begins = elsewhere.begins, stands = elsewhere.stands;
  char text[256];
  std::snprintf(
      text, sizeof text,
      "waypoint 0, %s: begins at %.6g %s, but the joint will be at %.6g %s after the jobs "
      "accepted for the arm",
      joint.name.c_str(), without_rounding_noise(begins), joint.unit().c_str(),
      without_rounding_noise(stands), joint.unit().c_str());
  std::string detail = text;
  if (joint.kind != JointKind::prismatic) {
    detail += whole_turns_apart(stands, begins, cell.execution.start_tolerance_rad);
  }
  detail += is_gripper_joint(cell, elsewhere.joint)
                ? "; begin there, or move the gripper there first (\"move_to\")"
                : "; begin there, or give the first waypoint a time above 0 in which the arm "
                  "may get to it, or, in a job without steps, let the server move the "
                  "arm to the start (\"move_to_start\": \"plan\")";
  return {ProblemKind::invalid, "start-mismatch",
          "/points/0/positions/" + std::to_string(elsewhere.place), std::move(detail), begins};
}

}  // namespace

void find_start_elsewhere(const Cell& cell, const Trajectory& trajectory, const Configuration& rest,
                          Problems& problems, Compared compared) {
  for (const JointElsewhere& one : joints_elsewhere(cell, trajectory, rest)) {
    const bool counts = compared == Compared::all_joints || is_gripper_joint(cell, one.joint);
    if (counts) problems.push_back(problem_of(cell, one));
  }
}

void find_start_elsewhere(const Cell& cell, const TrajectoryRequest& request,
                          const Configuration& rest, Problems& problems) {
  if (request.points.empty()) return;
  const std::vector<double>& begins = request.points.front().positions;
  if (begins.size() != request.joint_names.size()) return;
  std::vector<JointId> joints;
  for (const std::string& name : request.joint_names) {
    const auto joint = find_joint(name, request.arm, cell);
    if (!joint) return;
    joints.push_back(*joint);
  }
  const auto size = static_cast<Eigen::Index>(begins.size());
  const Eigen::VectorXd start = Eigen::Map<const Eigen::VectorXd>(begins.data(), size);
  for (const JointElsewhere& one : joints_elsewhere(cell, joints, start, rest)) {
    problems.push_back(problem_of(cell, one));
  }
}

}  // namespace armloom
