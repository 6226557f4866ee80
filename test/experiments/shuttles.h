#pragma once

#include <cstdint>
#include <vector>

#include "test/experiments/job_maker.h"

namespace armloom::experiments {

// Two Pandas commute between home and random published poses, one job per motion: 10 trips of one
// arm (the first for odd seeds), 8 of the other.
[[nodiscard]] std::vector<PlannedJob> shuttle_jobs(const CellPtr& cell, std::uint64_t seed);

// The same poses, but one job both visits a pose and returns. Both arms have equally many jobs, and
// jobs to the same pose follow each other.
[[nodiscard]] std::vector<PlannedJob> visits(const CellPtr& cell, std::uint64_t seed);
// Fifteen visits that either arm could make, each arm with its own pose. They are assigned to the
// arms in turn, or left to the scheduler (JobRequest::alternatives; `arm` is the first). After
// every three visits there is one more that only one arm can make (the first for odd seeds).
[[nodiscard]] std::vector<PlannedJob> visits_in_turn(const CellPtr& cell, std::uint64_t seed);
[[nodiscard]] std::vector<PlannedJob> visits_by_either(const CellPtr& cell, std::uint64_t seed);

}  // namespace armloom::experiments
