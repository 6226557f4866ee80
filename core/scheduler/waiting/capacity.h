#pragma once

#include <optional>
#include <vector>

#include "core/jobs/transitions.h"

namespace armloom {

// Places: the meaning of Policy::capacity. Under Capacity::rounds, the jobs of the present round
// have a place. The jobs of a round start together; if they are in conflict, they run one after the
// other. Rounds are fair by themselves: no job ages.

[[nodiscard]] bool has_rounds(const State& state);
// Returns a job that must end before the waiting `job` is checked; nullopt if a place is free.
[[nodiscard]] std::optional<JobId> place_taken_by(const State& state, const Step& step);
// Removes ended jobs from the round, and adds jobs:
// - if no job of the round has moved: the jobs of arms that have none in it
// - if all jobs of the round wait for other jobs or arms: jobs that could move these arms away
// - jobs of the server that must precede a job of the round
void renew_round(Transitions& state);
// Gives the place of any of these jobs to the first of them.
void give_place_to_first(Transitions& state, const std::vector<JobId>& jobs);

}  // namespace armloom
