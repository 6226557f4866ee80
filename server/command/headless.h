#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/executive/simulation.h"
#include "core/trajectory/trajectory.h"
#include "server/comparison/run_summary.h"

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

// Jobs that were refused at their time, each with its place in the file, on stderr. `under`: the
// policy, where there are several runs.
void complain_of_refusals(const SimulationResult& result, const std::string& jobs_file,
                          const std::string& under = "");

// Whether the run ended before its jobs, each job of a client that did not succeed, and each that
// did not end, and what it waits for if it has not ended, on stderr: counts alone do not tell.
// `under` as above.
void complain_of_ends(const SimulationResult& result, const std::string& under = "");

}  // namespace armloom
