#pragma once

#include <optional>

#include "core/jobs/state.h"

namespace armloom {

inline constexpr Duration kAtLimit = std::chrono::milliseconds(2);

// Returns what holds back an admitted job; nullopt if it moves or is about to.
[[nodiscard]] std::optional<Wait> held_where_it_stands(const State& state, const Record& record);
// Returns true if an arm of the job rests in the path of a motion ahead of it on another of its
// arms.
[[nodiscard]] bool holds_one_ahead(const State& state, const Record& record);
// Returns true if the job cannot move before other jobs have moved.
[[nodiscard]] bool stands(const State& state, const Record& record);

// Returns the earlier job with an undecided arm that may yet bring an arm to this job's start;
// nullopt if there is none or the arms are there.
[[nodiscard]] std::optional<JobId> may_go_first(const State& state, const Record& record);

// Returns the waits of the last check or the present pause; null if not known.
[[nodiscard]] const std::vector<Wait>* known_waits(const State& state, const Job& job);
// Returns true if the wait is for an arm without jobs.
[[nodiscard]] bool is_idle_arm(const State& state, const Wait& wait);

}  // namespace armloom
