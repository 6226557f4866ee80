#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <tl/expected.hpp>
#include <vector>

#include "core/model/cell.h"
#include "core/planning/planner.h"

namespace armloom {

// Target pose of an arm's link, in the world (m).
struct PoseGoal {
  ArmId arm;
  LinkId link;
  Eigen::Isometry3d X_WL;
};

// Accuracy of solutions by the cell's own forward kinematics.
inline constexpr double kPoseWithin_m = 1e-4;
inline constexpr double kPoseWithin_rad = 1e-4;
// Maximum number of solutions.
inline constexpr std::size_t kPoseSolutionsMax = 16;

// Returns joint positions of the arm that put the link at the pose, within the joints' limits, the
// nearest to the arm's position in `at` first. Damped least squares on Orocos KDL's kinematics,
// from that position, home, named states and a fixed list of others; each solution once. Other
// joints stay as in `at`. Solutions may be in collision: the planner takes all as goals. Refusals,
// goal_not_reached: the arm does not move the link, or no solution was found, with the nearest
// pose. Thread-safe and deterministic.
[[nodiscard]] tl::expected<std::vector<Eigen::VectorXd>, PlanRefusal> reach_pose(
    const Cell& cell, const PoseGoal& goal, const Configuration& at);

}  // namespace armloom
