#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/executive/simulation.h"
#include "core/trajectory/trajectory.h"

namespace armloom {

// What the commands share that run a jobs file on simulated time.

struct JobsFile {
  std::string text;
  std::vector<TimedJob> jobs;
  std::vector<TrajectoryPtr> trajectories;  // of the jobs

  [[nodiscard]] TimePoint first_submit() const;  // TimePoint::max() without jobs
};
// Reads the file and finds every fault that no order of events can cure: trajectories beyond the
// cell's limits, ids used twice. On faults says each on stderr and returns nothing.
[[nodiscard]] std::optional<JobsFile> load_jobs(const std::string& file, const Cell& cell);

// After this much cell time something is wrong: every job has waited as long as it may and run as
// long as it may, one after the other.
[[nodiscard]] TimePoint time_limit(const std::vector<TimedJob>& jobs,
                                   const std::vector<FaultRequest>& faults, const Cell& cell);

// Jobs that were refused at their time, each with its place in the file, on stderr. `under`: the
// policy, where there are several runs.
void complain_of_refusals(const SimulationResult& result, const std::string& jobs_file,
                          const std::string& under = "");

// Whether the run ended before its jobs, each job of a client that did not succeed, and each that
// did not end, and what it waits for if it has not ended, on stderr: counts alone do not tell.
// `under` as above.
void complain_of_ends(const SimulationResult& result, const std::string& under = "");

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
