#pragma once

#include <cstdint>
#include <vector>

#include "test/experiments/job_maker.h"

namespace armloom::experiments {

// Two Pandas commute between home and random published poses, one job per motion: 10 trips of one
// arm (the first for odd seeds), 8 of the other.
[[nodiscard]] std::vector<PlannedJob> shuttle_jobs(const CellPtr& cell, std::uint64_t seed);

// The same poses, visited and left by one job; equal numbers per arm, equal poses consecutive.
[[nodiscard]] std::vector<PlannedJob> visits(const CellPtr& cell, std::uint64_t seed);
// Fifteen visits that either arm could make, with its own poses, assigned in turn or left to the
// scheduler (JobRequest::alternatives; `arm` is the first). After every three, one more that one
// arm must make (the first for odd seeds).
[[nodiscard]] std::vector<PlannedJob> visits_in_turn(const CellPtr& cell, std::uint64_t seed);
[[nodiscard]] std::vector<PlannedJob> visits_by_either(const CellPtr& cell, std::uint64_t seed);

}  // namespace armloom::experiments
