#pragma once

#include <optional>

#include "core/jobs/transitions.h"

namespace armloom {

// A motion that has taken longer than duration x execution.duration_scaling + duration_margin
// overruns only when it has also not moved for this long. To end a slow motion earlier would clear
// no path.
inline constexpr Duration kStandstill = std::chrono::seconds(10);

// Returns when the job's backlog timeout is over if nothing changes; nullopt if the timeout is not
// running, or TimePoint::max() if it stands still because a speed override is 0. The timeout counts
// by the motion clock (SpeedOverride).
[[nodiscard]] std::optional<TimePoint> expiry_of(const State& state, const Step& step);

// Ends motions that overrun, and jobs whose timeout is over. With OnTimeout::replan, a job is
// replanned first.
void expire_and_overrun(Transitions& state);
// Returns when expire_and_overrun() must be called next. Also starts the timeout of jobs that an
// idle arm or an object now blocks on their path.
[[nodiscard]] std::optional<TimePoint> next_deadline(Transitions& state);

}  // namespace armloom
