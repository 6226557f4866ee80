#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/executive/simulation.h"
#include "core/trajectory/trajectory.h"
#include "server/comparison/run_summary.h"

namespace armloom {

struct JobsFile {
  std::string text;
  std::vector<TimedJob> jobs;
  std::vector<TrajectoryPtr> trajectories;  // first trajectory of each job that has one

  [[nodiscard]] TimePoint first_submit() const;  // TimePoint::max() if there are no jobs
};
// Prints faults that do not depend on the course of events (limits, duplicate ids) and returns
// nullopt if there are any.
[[nodiscard]] std::optional<JobsFile> load_jobs(const std::string& file, const Cell& cell);

// Prints jobs refused on submission, with their places. `under`: the policy, if several are
// simulated.
void complain_of_refusals(const SimulationResult& result, const std::string& jobs_file,
                          const std::string& under = "");

// Prints each client's job that did not succeed, and what it waits for.
void complain_of_ends(const SimulationResult& result, const std::string& under = "");

}  // namespace armloom
