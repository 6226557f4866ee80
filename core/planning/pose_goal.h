#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <tl/expected.hpp>
#include <vector>

#include "core/model/cell.h"
#include "core/planning/planner.h"

namespace armloom {

// Where a link of an arm is to be, in the world (m).
struct PoseGoal {
  ArmId arm;
  LinkId link;
  Eigen::Isometry3d X_WL;
};

// How exactly a solution reaches it, by the cell's own forward kinematics.
inline constexpr double kPoseWithin_m = 1e-4;
inline constexpr double kPoseWithin_rad = 1e-4;
// So many joint positions are handed on at most.
inline constexpr std::size_t kPoseSolutionsMax = 16;

// Joint positions of the arm that put the link there, within the joints' limits, the nearest to
// where the arm stands in `at` first: damped least squares on Orocos KDL's kinematics from where it
// stands, its home, its named states and a fixed list of further places, each solution once. (Of a
// redundant arm each seed finds another one.) All other joints stand as in `at`. Whether they are
// free is the planner's to say: it takes all of them as goals. Refusals, goal_not_reached: the arm
// does not move the link, or no such positions were found, with the nearest pose that was.
// Thread-safe; the same in, the same out.
[[nodiscard]] tl::expected<std::vector<Eigen::VectorXd>, PlanRefusal> reach_pose(
    const Cell& cell, const PoseGoal& goal, const Configuration& at);

}  // namespace armloom
