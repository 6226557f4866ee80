#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "core/base/time.h"
#include "core/executive/simulation.h"
#include "core/model/cell.h"

namespace armloom {

// After this much cell time something is wrong: every job has waited as long as it may and run as
// long as it may, one after the other.
[[nodiscard]] TimePoint time_limit(const std::vector<TimedJob>& jobs,
                                   const std::vector<FaultRequest>& faults, const Cell& cell);

// Of the clients' jobs; moves aside of the server's own are not counted.
struct RunSummary {
  Duration makespan{};  // from the first submission to the last end; zero: no job started
  // To the end of the run where that is later, as with jobs that do not end and go on moving arms:
  // what the arms' busy times are shares of.
  Duration span{};
  // Every terminal state and "refused"; other states only when the time limit came first.
  std::map<std::string, std::size_t> jobs;
  Duration wait_mean{};  // of jobs that started, from submission to start
  Duration wait_max{};
};
[[nodiscard]] RunSummary summarise(const SimulationResult& result, TimePoint first_submit);

}  // namespace armloom
