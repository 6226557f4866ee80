#pragma once

#include <cstdint>
#include <vector>

#include "test/experiments/job_maker.h"

namespace armloom::experiments {

// Of the two Pandas of config/two_pandas: each goes to and fro between home and poses drawn from
// those that its scenario publishes, a job a move, 36 jobs: 10 trips of one arm (the first one for
// odd seeds), 8 of the other.
[[nodiscard]] std::vector<PlannedJob> shuttle_jobs(const CellPtr& cell, std::uint64_t seed);

}  // namespace armloom::experiments
