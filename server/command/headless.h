#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/executive/simulation.h"
#include "core/trajectory/trajectory.h"
#include "server/comparison/run_summary.h"

namespace armloom {

// Shared by the commands that simulate a jobs file.

struct JobsFile {
  std::string text;
  std::vector<TimedJob> jobs;
  std::vector<TrajectoryPtr> trajectories;  // first trajectory of each job that has one

  [[nodiscard]] TimePoint first_submit() const;  // TimePoint::max() if there are no jobs
};
// Reads the file and reports on stderr every fault that does not depend on the course of events:
// trajectories beyond the cell's limits, duplicate ids. Returns nullopt if there are faults.
[[nodiscard]] std::optional<JobsFile> load_jobs(const std::string& file, const Cell& cell);

// Prints on stderr the jobs that were refused on submission, each with its place in the file.
// `under`: the policy, if several are simulated.
void complain_of_refusals(const SimulationResult& result, const std::string& jobs_file,
                          const std::string& under = "");

// Prints on stderr whether the simulation ended before its jobs, and each job of a client that did
// not succeed; for a job that did not end, also what it waits for. `under` as above.
void complain_of_ends(const SimulationResult& result, const std::string& under = "");

}  // namespace armloom
