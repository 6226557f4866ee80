#include "core/executive/start_elsewhere.h"

#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "core/base/rounding_noise.h"
#include "core/base/whole_turns.h"

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

void find_start_elsewhere(const Cell& cell, const Trajectory& trajectory, const Configuration& rest,
                          Problems& problems) {
  for (std::size_t j = 0; j < trajectory.joints().size(); ++j) {
    const Joint& joint = cell.joint(trajectory.joints()[j]);
    const double begins = trajectory.start()[static_cast<Eigen::Index>(j)];
    const double stands = rest[static_cast<Eigen::Index>(trajectory.joints()[j].index())];
    if (std::abs(begins - stands) <= cell.execution.start_tolerance_rad) continue;
    char text[256];
    std::snprintf(
        text, sizeof text,
        "waypoint 0, %s: begins at %.6g %s, but the joint will be at %.6g %s after the jobs "
        "accepted for the arm",
        joint.name.c_str(), without_rounding_noise(begins), joint.unit().c_str(),
        without_rounding_noise(stands), joint.unit().c_str());
    std::string detail = text;
    if (joint.kind != JointKind::prismatic)
      detail += whole_turns_apart(stands, begins, cell.execution.start_tolerance_rad);
    problems.push_back({ProblemKind::invalid, "start-mismatch",
                        "/points/0/positions/" + std::to_string(j), std::move(detail), begins});
  }
}

}  // namespace armloom
