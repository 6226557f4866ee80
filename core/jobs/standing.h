#pragma once

#include <optional>

#include "core/jobs/state.h"

namespace armloom {

// A motion within this trajectory time of its limit is treated as held there.
inline constexpr Duration kAtLimit = std::chrono::milliseconds(2);

// Returns the wait for a speed override of 0, or for an arm that holds too much; nullopt if the
// job's arms may move.
[[nodiscard]] std::optional<Wait> speed_wait(const State& state, const Step& step);
// Returns the wait for what keeps the job's arms at rest until an operator acts: a stop, another
// arm whose position is not known, what arms hold, or a speed override of 0. nullopt if there is
// none.
[[nodiscard]] std::optional<Wait> operator_wait(const State& state, const Step& step);
// Returns what the job waits for if it has not started and JobTerms::start_when does not hold.
[[nodiscard]] std::optional<Wait> signal_wait(const State& state, const Step& step);
// Returns what an admitted job at its limit waits for; nullopt if it moves or is about to.
[[nodiscard]] std::optional<Wait> held_where_it_stands(const State& state, const Step& step);
// Returns true if one of the job's arms rests in the path of an admitted motion that precedes the
// job in an arm queue.
[[nodiscard]] bool holds_one_ahead(const State& state, const Step& step);

// Returns an earlier job with an undecided arm that may yet bring an arm to this job's start.
// nullopt if there is none, or if the arms are already there.
[[nodiscard]] std::optional<JobId> may_go_first(const State& state, const Step& step);

// Returns what the job waits for, from its last check or in its present pause; null if not known.
[[nodiscard]] const std::vector<Wait>* known_waits(const State& state, const Step& step);
// Returns true if the job waits for an arm at rest that has no job.
[[nodiscard]] bool is_idle_arm(const State& state, const Wait& wait);

// ---- Measured speed of motions ----

// A job's arms stand if they have not moved for Promises::stands_from.

// Returns true if the job is moving but its arms stand.
[[nodiscard]] bool is_standing(const Cell& cell, const Step& step, TimePoint now);

// Returns since when the job's arms have not moved although no passing order holds them (late,
// stalled, stopped). For a moving job: the time of its last movement.
[[nodiscard]] std::optional<TimePoint> stands_since(const Step& step);
// Returns the time since stands_since(); zero if the arms do not stand yet.
[[nodiscard]] Duration stood_for(const Cell& cell, const Step& step, TimePoint now);

// Returns the cell time per trajectory time, measured since the last rest or change of speed
// override. Returns `planned` (SpeedOverride::pace) if the difference is small or nothing is
// measured.
[[nodiscard]] double pace_of(const Cell& cell, const Step& step, double planned, TimePoint now);

}  // namespace armloom
