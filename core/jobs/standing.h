#pragma once

#include <optional>

#include "core/jobs/state.h"

namespace armloom {

// Nearer than this to its limit, a motion has come to it.
inline constexpr Duration kAtLimit = std::chrono::milliseconds(2);

// What keeps an admitted job from going on, or from beginning; nothing: it goes, or is about to.
[[nodiscard]] std::optional<Wait> held_where_it_stands(const State& state, const Record& record);
// One of its arms rests in the way of a motion that comes before it on another one of its arms.
[[nodiscard]] bool holds_one_ahead(const State& state, const Record& record);
// It moves only after others have moved.
[[nodiscard]] bool stands(const State& state, const Record& record);

// The earlier job with an open arm that may yet move an arm of this job: the job does not begin
// where its arms stand, but may where that one would leave them. Returns nullopt if there is none.
[[nodiscard]] std::optional<JobId> may_go_first(const State& state, const Record& record);

// As it was found when it was judged last, or where it pauses; null: it is not known.
[[nodiscard]] const std::vector<Wait>* known_waits(const State& state, const Job& job);
// It waits for an arm that no job will move.
[[nodiscard]] bool is_idle_arm(const State& state, const Wait& wait);

}  // namespace armloom
