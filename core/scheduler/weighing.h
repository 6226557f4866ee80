#pragma once

#include <optional>
#include <vector>

#include "core/jobs/state.h"

namespace armloom {

// Chooses the orders of all that is admitted anew where something is not as expected: late, early,
// stopped, given up. Nobody's authority is taken back; whoever is late may lose its turn.
void weigh_again(State& state);

// Whether something is, as things are.
[[nodiscard]] bool is_off_course(const State& state);

// When that is to be looked at without another input; nothing: never.
[[nodiscard]] std::optional<TimePoint> weighs_next(const State& state);

// Before orders are chosen for what is admitted and these jobs: what waits behind all of them
// counts for the choice, what stands though nothing of ours holds it is expected to do so for as
// long again, what is slow to stay so, and who has been overtaken for long is overtaken no more.
void prepare_choice(State& state, const std::vector<JobId>& jobs);

}  // namespace armloom
