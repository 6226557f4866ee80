#pragma once

#include "core/planning/planner.h"
#include "core/trajectory/timing/time_parameterisation.h"

namespace armloom {

// A way with times: what `POST /jobs` takes.
struct PlannedMotion {
  JointWay way;
  TimedMotion timed;
  // How far corners of the way were cut (joint space, rad or m); 0: the arm rests at each.
  double rounded_within = 0.0;
};

// Plans (Planner), gives times (time_parameterisation.h) and has the outcome judged as a job would
// be (Swept, everything else standing still), for its whole length: corners are cut as widely as
// that allows, and where it allows none, the arm rests at them. Throws as Planner and time_path do.
// Thread-safe.
[[nodiscard]] tl::expected<PlannedMotion, PlanRefusal> plan_motion(
    const Planner& planner, const PlanRequest& request, const TimingOptions& options = {});

}  // namespace armloom
