#pragma once

#include <optional>

#include "core/jobs/state.h"

namespace armloom {

// A motion that takes longer than execution.duration_scaling and _margin allow overruns only when
// it has not moved for this long: one that is slow or late comes to its end, and to end it earlier
// would free nobody's way.
inline constexpr Duration kStandstill = std::chrono::seconds(10);

// When a job that waits in the backlog, or on its path in vain, is given up, if nothing changes.
[[nodiscard]] std::optional<TimePoint> expiry_of(const Job& job);

// Ends what has waited in the backlog, or on its path in vain, for longer than its timeout, and
// motions that overrun.
void expire_and_overrun(State& state);
// When something of that may happen next. What waits in vain as this step leaves it is timed from
// now.
[[nodiscard]] std::optional<TimePoint> next_deadline(State& state);

}  // namespace armloom
