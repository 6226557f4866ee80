#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "core/arm/arm_controller.h"
#include "core/executive/executive.h"

namespace armloom {

struct TimedJob {
  TimePoint at;  // when it is submitted
  JobRequest job;
};

struct SimulationResult {
  RunFigures figures;
  std::vector<JobView> jobs;  // every job that was accepted, as it ended, in order of submission
  std::vector<Problems> refused;  // of jobs that were refused at their time, see refused_index
  std::vector<std::size_t> refused_index;
  bool all_ended = false;  // false: `time_limit` came first
  TimePoint ended_at{};
};

// The same executive on simulated time, as fast as the machine allows, deterministic for a seed.
// A judgement takes kSimulatedJudgement of simulated time. Runs until every job has ended and all
// are submitted, or until `time_limit`.
inline constexpr Duration kSimulatedJudgement = std::chrono::milliseconds(2);
[[nodiscard]] Result<SimulationResult> simulate(CellPtr cell, ExecutiveOptions options,
                                                std::vector<TimedJob> jobs, TimePoint time_limit,
                                                Observer& observer);

}  // namespace armloom
