#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "core/base/time.h"
#include "core/executive/simulation.h"
#include "core/model/cell.h"

namespace armloom {

// Returns the cell time by which all jobs end, even if they run one after the other and each waits
// and runs as long as permitted.
[[nodiscard]] TimePoint time_limit(const std::vector<TimedJob>& jobs,
                                   const std::vector<FaultRequest>& faults, const Cell& cell);

// Summary of the clients' jobs, without the server's own.
struct RunSummary {
  Duration makespan{};  // first submission to last end; zero if no job started
  // The makespan if all jobs ended, else the time from the first submission to the end of the
  // simulation: jobs that do not end still move arms. The arms' busy shares refer to this time.
  Duration span{};
  // Number of jobs by state: all terminal states and "refused". Other states occur only if the time
  // limit was reached.
  std::map<std::string, std::size_t> jobs;
  Duration wait_mean{};  // of jobs that started, from submission to start
  Duration wait_max{};
};
[[nodiscard]] RunSummary summarise(const SimulationResult& result, TimePoint first_submit);

}  // namespace armloom
