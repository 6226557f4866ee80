#pragma once

#include "core/planning/plan_motion.h"
#include "core/planning/pose_goal.h"

namespace armloom {

// Maximum distance of the link from its straight line at any instant, not only at samples.
inline constexpr double kLineWithin_m = 1e-3;
inline constexpr double kLineWithin_rad = 1e-2;
// Maximum steps of inverse kinematics along the line, and of a joint in one step. A joint that
// moves farther indicates a singularity or another posture.
inline constexpr double kLineStep_m = 5e-3;
inline constexpr double kLineStep_rad = 0.05;
inline constexpr double kLineJump = 0.2;  // rad or m

// Plans a motion of the link from its pose in request.at to the goal in a straight line of the
// world, turning uniformly, with times; checked for its whole length as by plan_motion(). Ignores
// request.goals, seed and budget. Refusals, each with the place on the line: line_broken
// (unreachable, a joint would jump, or the motion would leave the line) and line_blocked (with what
// is too close); goal_not_reached if the arm does not move the link. Pure and thread-safe.
[[nodiscard]] tl::expected<PlannedMotion, PlanRefusal> plan_line(const PlanningScenePtr& scene,
                                                                 const PoseGoal& goal,
                                                                 const PlanRequest& request,
                                                                 const TimingOptions& options);

}  // namespace armloom
