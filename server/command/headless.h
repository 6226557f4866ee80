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
// Loads a jobs file. Checks all that does not depend on the course of the simulation, for example
// limits and duplicate ids. If there are faults, prints them and returns nullopt.
[[nodiscard]] std::optional<JobsFile> load_jobs(const std::string& file, const Cell& cell);

// Prints the robots whose controllers are in other processes, but are simulated by this command.
void note_simulated_robots(const Cell& cell);

// Prints each job that was refused on submission, with its place in the file. `under`: the policy,
// if several policies are simulated.
void complain_of_refusals(const SimulationResult& result, const std::string& jobs_file,
                          const std::string& under = "");

// Prints each job that did not succeed, with the reason or what it still waits for. Omits jobs that
// the server created and that have ended.
void complain_of_ends(const SimulationResult& result, const std::string& under = "");

}  // namespace armloom
