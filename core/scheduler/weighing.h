#pragma once

#include <optional>
#include <vector>

#include "core/jobs/state.h"

namespace armloom {

// Re-optimizes the orders of all admitted motions if one deviates from its prediction: late, early,
// stopped, abandoned. Granted authority is not taken back; a late motion may lose its turn.
void weigh_again(State& state);

// Returns true if any admitted motion deviates from its prediction.
[[nodiscard]] bool is_off_course(const State& state);

// Returns when to check for deviations without another input; nullopt: never.
[[nodiscard]] std::optional<TimePoint> weighs_next(const State& state);

// Updates the precedence graph before orders are chosen for the admitted motions and these jobs:
// the work behind them, predicted rests and paces, and motions that may not be overtaken again.
void prepare_choice(State& state, const std::vector<JobId>& jobs);

}  // namespace armloom
