#pragma once

#include <cstdint>
#include <vector>

#include "test/experiments/job_maker.h"

namespace armloom::experiments {

// Of the two Pandas of config/two_pandas: each goes to and fro between home and poses drawn from
// those that its scenario publishes, a job a move, 36 jobs: 10 trips of one arm (the first one for
// odd seeds), 8 of the other.
[[nodiscard]] std::vector<PlannedJob> shuttle_jobs(const CellPtr& cell, std::uint64_t seed);

// The same poses, each visited and left again by one job: as many visits of each arm, those to one
// pose following each other.
[[nodiscard]] std::vector<PlannedJob> visits(const CellPtr& cell, std::uint64_t seed);
// Fifteen visits that either arm could make, of a pose of its own each: given to them in turn, or
// left to the scheduler (JobRequest::alternatives; `arm` is then the first one). Among them six
// that one arm has to make (the first one for odd seeds).
[[nodiscard]] std::vector<PlannedJob> visits_in_turn(const CellPtr& cell, std::uint64_t seed);
[[nodiscard]] std::vector<PlannedJob> visits_by_either(const CellPtr& cell, std::uint64_t seed);

}  // namespace armloom::experiments
