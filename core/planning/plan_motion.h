#pragma once

#include <optional>
#include <vector>

#include "core/collision/check/motion_checker.h"
#include "core/planning/planner.h"
#include "core/trajectory/timing/time_parameterisation.h"

namespace armloom {

// That there is no way past the others as they stand, though these were left out.
struct NotPast {
  std::vector<ArmId> left_out;
  PlanRefusal why;
};

// A way with times: what `POST /jobs` takes.
struct PlannedMotion {
  JointWay way;
  TimedMotion timed;
  // How far corners of the way were cut (joint space, rad or m); 0: the arm rests at each.
  double rounded_within = 0.0;
  // As if all that may move were gone (answer_plan.h).
  std::optional<NotPast> not_past = {};
  bool goes_through = false;  // some of these were left out
};

// What stands against the motion as a job would be judged (Swept), everything else standing as in
// request.at, arms that are left out gone; nothing: it is free.
[[nodiscard]] std::optional<Conflict> found_in_the_way(MotionChecker& checker,
                                                       const PlanRequest& request,
                                                       const TrajectoryPtr& trajectory);

// Plans (Planner), gives times (time_parameterisation.h) and has the outcome judged as a job would
// be (Swept, everything else standing still), for its whole length: corners are cut as widely as
// that allows, and where it allows none, the arm rests at them. Throws as Planner and time_path do.
// Thread-safe.
[[nodiscard]] tl::expected<PlannedMotion, PlanRefusal> plan_motion(
    const Planner& planner, const PlanRequest& request, const TimingOptions& options = {});

}  // namespace armloom
