#pragma once

#include <optional>
#include <vector>

#include "core/jobs/state.h"

namespace armloom {

// Chooses the orders of all that is admitted anew where something is not as expected: late, early,
// stopped, given up. Nobody's authority is taken back; whoever is late may lose its turn.
void weigh_again(State& state);

// When that is to be looked at without another input; nothing: never.
[[nodiscard]] std::optional<TimePoint> weighs_next(const State& state);

// It has not been seen to move for longer than an arm that sets out or brakes.
[[nodiscard]] bool is_standing(const Moving& moving, TimePoint now);

// How long its arms have stood for no reason of ours: late, stalled, stopped. Zero: it moves, or
// waits for others.
[[nodiscard]] Duration stood_for(const Job& job, TimePoint now);

// Of cell time for one of its trajectory, as it has gone since it last stood; 1: at about the speed
// that it was to have, or not known.
[[nodiscard]] double pace_of(const Job& job, TimePoint now);

// Before orders are chosen for what is admitted and these jobs: what waits behind all of them
// counts for the choice, what stands though nothing of ours holds it is expected to do so for as
// long again, what is slow to stay so, and who has been overtaken for long is overtaken no more.
void prepare_choice(State& state, const std::vector<JobId>& jobs);

}  // namespace armloom
