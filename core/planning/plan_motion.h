#pragma once

#include <optional>
#include <vector>

#include "core/collision/check/motion_checker.h"
#include "core/planning/planner.h"
#include "core/trajectory/timing/time_parameterization.h"

namespace armloom {

// A failed try to plan around the other arms at rest. `left_out` are arms that were ignored even
// then; `why` is the refusal.
struct NotPast {
  std::vector<ArmId> left_out;
  PlanRefusal why;
};

// A path with times, as `POST /jobs` takes it.
struct PlannedMotion {
  JointWay way;
  TimedMotion timed;
  // Maximum cut of the path's corners (joint space, rad or m); 0 if the arm rests at each corner.
  double rounded_within = 0.0;
  // Set if no path was found around the other arms at rest. The plan then ignores all arms that may
  // move (answer_plan.h).
  std::optional<NotPast> not_past = {};
  bool goes_through = false;  // the plan ignores arms that may move
};

// Checks the motion as a job (method Swept), with everything else at rest as in request.at. Returns
// a conflict, or nullopt if the motion is free. Ignores conflicts with arms in request.left_out.
[[nodiscard]] std::optional<Conflict> found_in_the_way(MotionChecker& checker,
                                                       const PlanRequest& request,
                                                       const TrajectoryPtr& trajectory);

// Plans a path (Planner), computes its times (time_parameterization.h), and checks the motion as a
// job over its whole length (method Swept, everything else at rest). Corners are cut as widely as
// the check allows; if it allows no cut, the arm rests at each corner. Throws the exceptions of
// Planner and time_path. Thread-safe.
[[nodiscard]] tl::expected<PlannedMotion, PlanRefusal> plan_motion(
    const Planner& planner, const PlanRequest& request, const TimingOptions& options = {});

}  // namespace armloom
