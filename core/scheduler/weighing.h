#pragma once

#include <optional>
#include <vector>

#include "core/jobs/transitions.h"

namespace armloom {

// Chooses the orders of all admitted motions again if one of them deviates from its prediction
// (late, early, stopped, abandoned). A late motion may then lose its turn, but granted authority is
// not taken back.
void weigh_again(Transitions& state);

// Returns true if any admitted motion deviates from its prediction.
[[nodiscard]] bool is_off_course(const State& state);

// Returns when to check for deviations if no input comes before; nullopt if this is not needed.
[[nodiscard]] std::optional<TimePoint> weighs_next(const State& state);

// Returns for each arm (ArmId) the predicted time of its jobs except these, at the present speed
// override.
[[nodiscard]] std::vector<Duration> work_behind(const State& state,
                                                const std::vector<const Step*>& in_front);

// Updates the precedence graph before orders are chosen for the admitted motions and for `steps`.
// Sets the work behind all of these, predicted rests and paces, and which motions may not be
// overtaken any more.
void prepare_choice(Transitions& state, const std::vector<StepId>& steps);

// For policies without passing orders (timed_discrete).

// Call when an arm brakes, or rests off its goal. All motions under way will be checked again.
// Scheduled jobs whose arms are stopped return to the queue.
void compare_again(Transitions& state);
// Does the same if an arm under way has newly come to rest (late, stalled).
void see_standing(Transitions& state);
// Returns when see_standing() must be called next.
[[nodiscard]] std::optional<TimePoint> stands_next(const State& state);

}  // namespace armloom
