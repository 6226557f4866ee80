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

// A share of the jobs, drawn between these, begins up to kLatest_s late and goes at kSlowest to
// kFastest of its speed: the same ones under every policy, and none knows of it beforehand.
inline constexpr double kLeastShare = 0.1;
inline constexpr double kMostShare = 0.3;
inline constexpr double kLatest_s = 2.0;
inline constexpr double kSlowest = 0.3;
inline constexpr double kFastest = 0.8;
void delay_some(std::vector<PlannedJob>& jobs, std::uint64_t seed);

// A motion as an arm makes it that begins so late and is so slow, and never waits for anybody: what
// it takes beyond the motion is rounded down so that the whole is a multiple of
// JoinedDiagram::kSquare. Precondition: the motion is one.
[[nodiscard]] TrajectoryPtr as_delayed(const Trajectory& motion, const JobDelay& delay);

// As simulate(), with arms that are late and slow with the jobs that are to be. An arm is told to
// start late from when the job before has started, and to be slow from the job's start to its end;
// a move aside that comes between is late in the job's stead.
[[nodiscard]] Result<SimulationResult> simulate_delayed(const CellPtr& cell,
                                                        ExecutiveOptions options,
                                                        const std::vector<PlannedJob>& jobs,
                                                        TimePoint time_limit, Observer& observer);

}  // namespace armloom::experiments
