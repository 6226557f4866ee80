#pragma once

#include "core/planning/plan_motion.h"
#include "core/planning/pose_goal.h"

namespace armloom {

// Maximum distance of the link from its straight line at any instant, not only at samples.
inline constexpr double kLineWithin_m = 1e-3;
inline constexpr double kLineWithin_rad = 1e-2;
// Maximum step of inverse kinematics along the line, and maximum motion of a joint in one step. A
// larger motion indicates a singularity or another posture.
inline constexpr double kLineStep_m = 5e-3;
inline constexpr double kLineStep_rad = 0.05;
inline constexpr double kLineJump = 0.2;  // rad or m

// Plans a timed motion of the link from its pose in request.at to the goal. The link moves in a
// straight line in the world and turns uniformly. The motion is checked as a job over its whole
// length, as in plan_motion(). Ignores request.goals, seed and budget. Refusals:
// - line_broken, with the place on the line: a pose is unreachable, a joint would jump, or the
//   motion would leave the line;
// - line_blocked, with the place on the line: something is too close to the arm;
// - goal_not_reached: the arm does not move the link.
// Thread-safe and deterministic.
[[nodiscard]] tl::expected<PlannedMotion, PlanRefusal> plan_line(const PlanningScenePtr& scene,
                                                                 const PoseGoal& goal,
                                                                 const PlanRequest& request,
                                                                 const TimingOptions& options);

}  // namespace armloom
