#pragma once

#include "core/jobs/transitions.h"

namespace armloom {

// Jobs with goals (Submit::goals). Such a job has an estimated trajectory and the blocking
// condition `plan` until its path is planned. The path begins where the jobs before it leave its
// arm, and leads around the other arms where those jobs leave them. Then it is a job like any
// other. If the arm is undecided, a path is planned for each candidate arm, and the arm that
// arrives first is chosen at the job's turn (waiting/choosing.h). An arm is no candidate while jobs
// before this one in its queue have no plan. Until the choice, jobs behind this one are planned as
// if it took another arm.

// If the arm is too close to an object, no path is planned until the scene has changed. At its turn
// the job waits for the object in the backlog, until its timeout.

// Requests a plan (PlanMotion) for each job with a goal that has none, or whose plan is out of date
// because its start or the scene has changed. A job fails if kPlansMax plans in succession are out
// of date. Returns true if a job failed, because later jobs then begin elsewhere.
[[nodiscard]] bool plan_goals(Transitions& state);
inline constexpr int kPlansMax = 5;
// Number of jobs per arm queue for which paths are planned.
inline constexpr std::size_t kPlannedAhead = 16;

// Discards a valid plan, so that the job is planned again.
void forget_plan(Transitions& state, const Step& step);

// Handles the planner's answer for one of the job's goals. If the plan is out of date, plan_goals()
// requests another.
void take_goal_plan(Transitions& state, const Step& step, std::size_t which,
                    const PlanMade& answer);

}  // namespace armloom
