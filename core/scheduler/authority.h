#pragma once

#include <optional>

#include "core/jobs/state.h"

namespace armloom {

// How far each motion that is admitted may go: orders, held by authority over progress.

// Tells what is admitted to its arms when precedence lets it leave its place, and how much farther
// what is under way may go.
void dispatch_ready(State& state);
// The same of what waits for this motion, and of itself: it has moved.
void extend_authority(State& state, JobId moved);
// At rest at its limit a running motion pauses; what it loses there is no overrun.
void see_pauses(State& state, Record& record, Duration progress_before);

// What keeps an admitted job from going on, or from beginning; nothing: it goes, or is about to.
[[nodiscard]] std::optional<Wait> held_where_it_stands(const State& state, const Record& record);
// One of its arms rests in the way of a motion that comes before it on another one of its arms.
[[nodiscard]] bool holds_one_ahead(const State& state, const Record& record);
// It moves only after others have moved.
[[nodiscard]] bool stands(const State& state, const Record& record);

}  // namespace armloom
