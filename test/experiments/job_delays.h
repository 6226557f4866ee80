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

// A random share of the jobs between these values starts up to kLatest_s late and runs at kSlowest
// to kFastest of its speed. The jobs are the same under every policy, and no policy knows of them
// beforehand.
inline constexpr double kLeastShare = 0.1;
inline constexpr double kMostShare = 0.3;
inline constexpr double kLatest_s = 2.0;
inline constexpr double kSlowest = 0.3;
inline constexpr double kFastest = 0.8;
void delay_some(std::vector<PlannedJob>& jobs, std::uint64_t seed);

// Returns the motion that a late and slow arm makes if it never waits. Its extra time is rounded
// down so that the duration is a multiple of JoinedDiagram::kSquare. Precondition: the motion's
// duration is such a multiple.
[[nodiscard]] TrajectoryPtr as_delayed(const Trajectory& motion, const JobDelay& delay);

// Like simulate(), with arms that are late and slow for the delayed jobs. The late start is
// injected when the previous job has started, the low speed from the job's start to its end. If a
// retreat comes in between, the retreat is late instead of the job.
[[nodiscard]] Result<SimulationResult> simulate_delayed(const CellPtr& cell,
                                                        ExecutiveOptions options,
                                                        const std::vector<PlannedJob>& jobs,
                                                        TimePoint time_limit, Observer& observer);

}  // namespace armloom::experiments
