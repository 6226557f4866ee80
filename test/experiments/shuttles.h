#pragma once

#include <cstdint>
#include <vector>

#include "test/experiments/job_maker.h"

namespace armloom::experiments {

// Returns jobs for the two Pandas of config/two_pandas, which commute between home and random
// published poses of their scenario, one job per motion. 36 jobs: 10 trips of one arm (the first
// for odd seeds), 8 of the other.
[[nodiscard]] std::vector<PlannedJob> shuttle_jobs(const CellPtr& cell, std::uint64_t seed);

// Returns jobs with the same poses, each visited and left again by one job. Same number of visits
// per arm; visits to the same pose are consecutive.
[[nodiscard]] std::vector<PlannedJob> visits(const CellPtr& cell, std::uint64_t seed);
// Returns fifteen visits that either arm could make, each arm with its own poses. Assigned to the
// arms in turn, or left to the scheduler (JobRequest::alternatives; `arm` is then the first). Five
// more visits, one after every three, must be made by one arm (the first for odd seeds).
[[nodiscard]] std::vector<PlannedJob> visits_in_turn(const CellPtr& cell, std::uint64_t seed);
[[nodiscard]] std::vector<PlannedJob> visits_by_either(const CellPtr& cell, std::uint64_t seed);

}  // namespace armloom::experiments
