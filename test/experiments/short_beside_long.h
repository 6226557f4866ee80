#pragma once

#include <cstdint>
#include <vector>

#include "test/experiments/job_maker.h"

namespace armloom::experiments {

// Returns twelve short tasks and four tasks that take three times as long, equal work. For odd
// seeds the first arm gets the short tasks.
[[nodiscard]] std::vector<PlannedJob> short_beside_long(const CellPtr& two_pandas,
                                                        std::uint64_t seed);

}  // namespace armloom::experiments
