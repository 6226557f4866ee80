#pragma once

#include <optional>
#include <string>

#include "core/jobs/state.h"

namespace armloom {

// Replans a job that waits or rests on its path: from its arm's position to its present end, around
// all other arms at their rests after all admitted motions. A moving job is first braked. Until the
// plan arrives the job stays at rest (blocking condition `plan`). If there is no other path it
// keeps its own, and nothing else changes. With another path it waits like a new job, under its id.

// Replans of one job without a client's request; each for different surroundings.
inline constexpr int kReplansMax = 3;

// Returns one sentence why the job cannot be replanned; nullopt if it can.
[[nodiscard]] std::optional<std::string> why_not_replanned(const Job& job);

// Requests a replan. No effect if one is open or the path to its goal is being planned.
// Precondition: why_not_replanned() returns nullopt.
void ask_for_another_way(State& state, Record& record, AnotherWay::Cause cause);
// Requests plans for jobs that have come to rest meanwhile (PlanMotion).
void plan_other_ways(State& state);
// Takes the answer to a PlanMotion if it is for a replan. Returns true if the job got another path.
[[nodiscard]] bool take_other_way(State& state, const PlanMade& answer);

// Returns true if the cell wants replans (on_idle_blocker "replan") and the job was not yet
// replanned in the present situation.
[[nodiscard]] bool may_go_around(const State& state, const Record& record);
// Replans the first job that waits for an arm that no job will move. Returns true if there is one.
[[nodiscard]] bool goes_around_idle_arm(State& state);
// The job's backlog timeout is over, in the backlog or on its path. Returns true if it is replanned
// instead of expiring (OnTimeout::replan).
[[nodiscard]] bool goes_on_after_timeout(State& state, Record& record);

}  // namespace armloom
