#pragma once

#include <cstdint>
#include <vector>

#include "test/experiments/job_maker.h"

namespace armloom::experiments {

// Twelve short tasks, and four that take three times as long. For odd seeds the first arm gets the
// short tasks.
[[nodiscard]] std::vector<PlannedJob> short_beside_long(const CellPtr& two_pandas,
                                                        std::uint64_t seed);

}  // namespace armloom::experiments
