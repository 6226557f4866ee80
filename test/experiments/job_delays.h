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

// Delays a random share of the jobs, between kLeastShare and kMostShare. They start up to kLatest_s
// late and run at kSlowest to kFastest of their speed. Delays are the same under every policy, and
// the scheduler does not know them in advance.
inline constexpr double kLeastShare = 0.1;
inline constexpr double kMostShare = 0.3;
inline constexpr double kLatest_s = 2.0;
inline constexpr double kSlowest = 0.3;
inline constexpr double kFastest = 0.8;
void delay_some(std::vector<PlannedJob>& jobs, std::uint64_t seed);

// Returns the motion of a late and slow arm that never waits. Its extra time is rounded down to a
// multiple of JoinedDiagram::kSquare. Precondition: the duration is such a multiple.
[[nodiscard]] TrajectoryPtr as_delayed(const Trajectory& motion, const JobDelay& delay);

// Simulates like simulate(), but with the delays. The late start is injected when the arm's
// previous job has started, the low speed from the job's start to its end. If the arm retreats in
// between, the retreat is late instead of the job.
[[nodiscard]] Result<SimulationResult> simulate_delayed(const CellPtr& cell,
                                                        ExecutiveOptions options,
                                                        const std::vector<PlannedJob>& jobs,
                                                        TimePoint time_limit, Observer& observer);

}  // namespace armloom::experiments
