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
#include "core/trajectory/implicit_start.h"

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

// Adds a problem if joint `j` of the trajectory begins elsewhere than it `stands`.
void compare_start(const Cell& cell, JointId id, std::size_t j, double begins, double stands,
                   Problems& problems) {
  const Joint& joint = cell.joint(id);
  if (std::abs(begins - stands) <= cell.execution.start_tolerance_rad) return;
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
  detail += is_gripper_joint(cell, id)
                ? "; begin there, or move the gripper there first (\"move_to\")"
                : "; begin there, or give the first waypoint a time above 0 in which the arm "
                  "may get to it, or let the server move the arm to the start "
                  "(\"move_to_start\": \"plan\")";
  problems.push_back({ProblemKind::invalid, "start-mismatch",
                      "/points/0/positions/" + std::to_string(j), std::move(detail), begins});
}

}  // namespace

void find_start_elsewhere(const Cell& cell, const Trajectory& trajectory, const Configuration& rest,
                          Problems& problems, Compared compared) {
  for (std::size_t j = 0; j < trajectory.joints().size(); ++j) {
    const JointId id = trajectory.joints()[j];
    if (compared == Compared::gripper_joints && !is_gripper_joint(cell, id)) continue;
    compare_start(cell, id, j, trajectory.start()[static_cast<Eigen::Index>(j)],
                  rest[static_cast<Eigen::Index>(id.index())], problems);
  }
}

void find_start_elsewhere(const Cell& cell, const TrajectoryRequest& request,
                          const Configuration& rest, Problems& problems) {
  if (request.points.empty()) return;
  const std::vector<double>& begins = request.points.front().positions;
  for (std::size_t j = 0; j < std::min(begins.size(), request.joint_names.size()); ++j) {
    const auto id = find_joint(request.joint_names[j], request.arm, cell);
    if (!id || !std::isfinite(begins[j])) continue;
    compare_start(cell, *id, j, begins[j], rest[static_cast<Eigen::Index>(id->index())], problems);
  }
}

}  // namespace armloom
