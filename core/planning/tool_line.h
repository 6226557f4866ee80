#pragma once

#include "core/planning/plan_motion.h"
#include "core/planning/pose_goal.h"

namespace armloom {

// So far the link may be from its straight line at any instant of the motion, not only where that
// was looked at.
inline constexpr double kLineWithin_m = 1e-3;
inline constexpr double kLineWithin_rad = 1e-2;
// Inverse kinematics goes along the line in steps of this length at most, and no joint goes farther
// in one: where it would, the line leads past a singular place or to another posture.
inline constexpr double kLineStep_m = 5e-3;
inline constexpr double kLineStep_rad = 0.05;
inline constexpr double kLineJump = 0.2;  // rad or m

// The link goes from where it stands in request.at to the pose in a straight line of the world,
// turning evenly on the way, with times; judged for its whole length as plan_motion() does.
// request.goals, seed and budget are not read. Refusals: line_broken (the pose, or a place on the
// line, is not reached, a joint would have to jump, or the motion would leave the line) and
// line_blocked (with what comes too close), each with how far along the line; goal_not_reached: the
// arm does not move the link. Pure and thread-safe.
[[nodiscard]] tl::expected<PlannedMotion, PlanRefusal> plan_line(const PlanningScenePtr& scene,
                                                                 const PoseGoal& goal,
                                                                 const PlanRequest& request,
                                                                 const TimingOptions& options);

}  // namespace armloom
