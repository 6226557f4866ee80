#pragma once

#include <optional>

#include "core/jobs/state.h"

namespace armloom {

// Jobs with goals (Submit::goals). Each has the blocking condition `plan` until its trajectory is
// planned from where its arm will be after the jobs before it, with all other arms where those jobs
// leave them; then it is a job like any other. Until then its trajectory is an estimate. If the arm
// is undecided, a path is planned for each candidate; the one that arrives first is chosen at its
// turn (waiting/choosing.h). Until then the jobs behind it are planned as if it took another arm.

// A job whose arm is too close to an object has no plan until the object is gone. At its turn it
// waits for the object in the backlog, until its timeout.

// Requests a plan (PlanMotion) for each goal job that has none, or whose plan is stale because its
// start or the scene changed. A job fails after kPlansMax consecutive stale plans. Returns true if
// a job failed, since that changes where later jobs start.
[[nodiscard]] bool plan_goals(State& state);
inline constexpr int kPlansMax = 5;
// Number of jobs per arm that are considered.
inline constexpr std::size_t kPlannedAhead = 16;

// Discards a valid plan, so that the job is planned again.
void forget_plan(State& state, Record& record);

// Takes a planner's answer. A stale plan is left to plan_goals().
void take_plan(State& state, const PlanMade& answer);

}  // namespace armloom
