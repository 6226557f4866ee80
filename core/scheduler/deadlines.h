#pragma once

#include <optional>

#include "core/jobs/state.h"

namespace armloom {

// A motion beyond execution.duration_scaling and _margin overruns only after it has not moved for
// this long. Ending a slow or late motion earlier would clear no path.
inline constexpr Duration kStandstill = std::chrono::seconds(10);

// Returns when the job expires, if nothing changes.
[[nodiscard]] std::optional<TimePoint> expiry_of(const Job& job);

// Ends motions that overrun, and jobs whose timeout is over in the backlog or on their path.
void expire_and_overrun(State& state);
// Returns when expire_and_overrun() has to act next. Also starts the timeout of jobs that are now
// blocked on their path by an idle arm or an object.
[[nodiscard]] std::optional<TimePoint> next_deadline(State& state);

}  // namespace armloom
