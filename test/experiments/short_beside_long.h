#pragma once

#include <cstdint>
#include <vector>

#include "test/experiments/job_maker.h"

namespace armloom::experiments {

// Twelve short tasks beside four that take three times as long, equal work. Odd seeds give the
// short ones to the first arm.
[[nodiscard]] std::vector<PlannedJob> short_beside_long(const CellPtr& two_pandas,
                                                        std::uint64_t seed);

}  // namespace armloom::experiments
