#pragma once

#include <optional>
#include <string>

#include "core/jobs/transitions.h"

namespace armloom {

// Replans a job that waits or rests on its path; a moving job is first braked. The new path leads
// from the arm's position to the job's present end, around all other arms where the admitted
// motions leave them. Until the plan arrives the job stays at rest (blocking condition `plan`).
// With a new path the job waits like a new job, under its id. If there is no other path it keeps
// its own, and nothing else changes.

// Largest number of replans of one job without a client's request. Each must be for different
// surroundings.
inline constexpr int kReplansMax = 3;

// Returns why the job cannot be replanned, as one sentence; nullopt if it can.
[[nodiscard]] std::optional<std::string> why_not_replanned(const Step& step);

// Requests a replan. No effect if a replan is open, or if the path to the job's goal is still being
// planned. Precondition: why_not_replanned() returns nullopt.
void ask_for_another_way(Transitions& state, const Step& step, AnotherWay::Cause cause);
// Requests plans (PlanMotion) for jobs that had to come to rest first and now are.
void plan_other_ways(Transitions& state);
// Handles the planner's answer for a replan. Returns true if the job got another path.
[[nodiscard]] bool take_other_way(Transitions& state, const Step& step, const PlanMade& answer);

// Returns true if the cell's on_idle_blocker is "replan" and the job may be replanned: not more
// than kReplansMax times, and not again in the same surroundings.
[[nodiscard]] bool may_go_around(const State& state, const Step& step);
// Replans the first job that waits for an arm that no job will move. Returns true if there is one.
[[nodiscard]] bool goes_around_idle_arm(Transitions& state);
// Call when the job's backlog timeout is over, in the backlog or on its path. Returns true if the
// job is replanned instead of expiring (OnTimeout::replan).
[[nodiscard]] bool goes_on_after_timeout(Transitions& state, const Step& step);
// Ends the job, at once or after braking, because its backlog timeout is over. `why`: appended.
void expire(Transitions& state, const Step& step, const std::string& why = "");

}  // namespace armloom
