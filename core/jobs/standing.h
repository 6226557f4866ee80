#pragma once

#include <optional>

#include "core/jobs/state.h"

namespace armloom {

// A motion closer to its limit than this has reached it.
inline constexpr Duration kAtLimit = std::chrono::milliseconds(2);

// Returns what holds back an admitted job at its start or on its path; nullopt if it moves or is
// about to.
[[nodiscard]] std::optional<Wait> held_where_it_stands(const State& state, const Record& record);
// Returns true if one of the job's arms rests in the path of a motion that precedes it on another
// of its arms.
[[nodiscard]] bool holds_one_ahead(const State& state, const Record& record);
// Returns true if the job can move only after other jobs have moved.
[[nodiscard]] bool stands(const State& state, const Record& record);

// Returns the earlier job with an undecided arm that may yet move an arm of this job, if this job
// does not begin where its arms rest; nullopt if there is none.
[[nodiscard]] std::optional<JobId> may_go_first(const State& state, const Record& record);

// Returns the waits found at the last check, or at the present pause; null if not known.
[[nodiscard]] const std::vector<Wait>* known_waits(const State& state, const Job& job);
// Returns true if the wait is for an arm that no job will move.
[[nodiscard]] bool is_idle_arm(const State& state, const Wait& wait);

}  // namespace armloom
