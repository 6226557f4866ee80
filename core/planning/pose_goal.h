#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <optional>
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

// Maximum error of a solution, computed by the cell's own forward kinematics.
inline constexpr double kPoseWithin_m = 1e-4;
inline constexpr double kPoseWithin_rad = 1e-4;
// Maximum number of solutions.
inline constexpr std::size_t kPoseSolutionsMax = 16;

// Returns joint positions of the arm, within their limits, that put the link at the pose. Each
// solution is returned once, the nearest to the arm's position in `at` first. Other joints stay as
// in `at`. Solutions may be in collision, so the planner takes all of them as goals. The method is
// damped least squares on Orocos KDL's kinematics. Seeds are the arm's position in `at`, its home,
// its named states and a fixed list of further positions. Refused (goal_not_reached) if the arm
// does not move the link, or if no solution was found. The latter refusal has the nearest pose
// found. Thread-safe and deterministic.
[[nodiscard]] tl::expected<std::vector<Eigen::VectorXd>, PlanRefusal> reach_pose(
    const Cell& cell, const PoseGoal& goal, const Configuration& at);

// Returns the first of these solutions, in the order of the seeds, for which `is_usable` returns
// true, or nullopt. Faster than reach_pose() if a usable solution exists.
[[nodiscard]] std::optional<Eigen::VectorXd> first_at_pose(
    const Cell& cell, const PoseGoal& goal, const Configuration& at,
    const std::function<bool(const Eigen::VectorXd&)>& is_usable);

}  // namespace armloom
