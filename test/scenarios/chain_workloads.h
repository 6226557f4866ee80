#pragma once

#include "test/scenarios/crowded_workloads.h"

namespace armloom {

// Returns pose-to-pose jobs of discs that block each other, all submitted at time zero. Executed
// one by one in submission order, each job has a free path. With `after`, about every third job has
// one or two predecessors among the jobs before it. Deterministic in its arguments. Throws
// std::runtime_error if no workload is found (never seen).
[[nodiscard]] CrowdedWorkload make_chain(std::size_t arms, std::size_t jobs, bool after,
                                         std::uint64_t seed);

}  // namespace armloom
