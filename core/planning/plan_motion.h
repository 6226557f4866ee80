#pragma once

#include <optional>
#include <vector>

#include "core/collision/check/motion_checker.h"
#include "core/planning/planner.h"
#include "core/trajectory/timing/time_parameterization.h"

namespace armloom {

// No path exists past the other arms at rest, although these were ignored.
struct NotPast {
  std::vector<ArmId> left_out;
  PlanRefusal why;
};

// A path with times, as `POST /jobs` takes it.
struct PlannedMotion {
  JointWay way;
  TimedMotion timed;
  // Maximum cut of the path's corners (joint space, rad or m); 0 if the arm rests at each.
  double rounded_within = 0.0;
  // Set if no path exists past the other arms at rest; the plan then ignores all arms that may move
  // (answer_plan.h).
  std::optional<NotPast> not_past = {};
  bool goes_through = false;  // the plan ignores some of them
};

// Returns a conflict of the motion, checked as a job (Swept) with everything else at rest as in
// request.at, or nullopt if it is free. Ignores arms that are left out.
[[nodiscard]] std::optional<Conflict> found_in_the_way(MotionChecker& checker,
                                                       const PlanRequest& request,
                                                       const TrajectoryPtr& trajectory);

// Plans (Planner), times (time_parameterization.h) and checks a motion as a job (Swept, everything
// else at rest) over its whole length. Corners are cut as widely as the check allows; otherwise the
// arm rests at them. Throws like Planner and time_path. Thread-safe.
[[nodiscard]] tl::expected<PlannedMotion, PlanRefusal> plan_motion(
    const Planner& planner, const PlanRequest& request, const TimingOptions& options = {});

}  // namespace armloom
