#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/executive/simulation.h"
#include "test/experiments/job_maker.h"

namespace armloom::experiments {

// A random share of the jobs starts up to kLatest_s late and runs at kSlowest to kFastest of its
// speed: the same jobs under every policy, unknown beforehand.
inline constexpr double kLeastShare = 0.1;
inline constexpr double kMostShare = 0.3;
inline constexpr double kLatest_s = 2.0;
inline constexpr double kSlowest = 0.3;
inline constexpr double kFastest = 0.8;
void delay_some(std::vector<PlannedJob>& jobs, std::uint64_t seed);

// Returns the motion of a late and slow arm that never waits. Its extra time is rounded down to a
// multiple of JoinedDiagram::kSquare. Precondition: the duration is such a multiple.
[[nodiscard]] TrajectoryPtr as_delayed(const Trajectory& motion, const JobDelay& delay);

// Like simulate(), with delayed jobs. The late start is injected when the previous job has started,
// the low speed from start to end. A retreat in between is late instead of the job.
[[nodiscard]] Result<SimulationResult> simulate_delayed(const CellPtr& cell,
                                                        ExecutiveOptions options,
                                                        const std::vector<PlannedJob>& jobs,
                                                        TimePoint time_limit, Observer& observer);

}  // namespace armloom::experiments
