#pragma once

#include <optional>

#include "core/jobs/state.h"

namespace armloom {

// A motion that takes longer than execution.duration_scaling and _margin allow overruns only after
// it has not moved for this long. Ending a slow or late motion earlier would clear no path.
inline constexpr Duration kStandstill = std::chrono::seconds(10);

// Returns when the job expires if nothing changes: in the backlog, or on its path waiting for
// something that no job moves; nullopt if it does not.
[[nodiscard]] std::optional<TimePoint> expiry_of(const Job& job);

// Ends jobs whose backlog timeout is over, in the backlog or on their path, and motions that
// overrun.
void expire_and_overrun(State& state);
// Returns the earliest time at which expire_and_overrun() has to act, or nullopt. Also starts the
// timeout of jobs that are now blocked on their path by an idle arm or an object.
[[nodiscard]] std::optional<TimePoint> next_deadline(State& state);

}  // namespace armloom
