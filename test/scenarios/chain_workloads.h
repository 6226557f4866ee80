#pragma once

#include "test/scenarios/crowded_workloads.h"

namespace armloom {

// Jobs from pose to pose, without home in between, of discs that are in each other's way: one after
// the other, in the order in which they are submitted, each finds its way free. All at once at time
// zero. With `after`, every third or so comes after one or two that were submitted before it.
// The same for the same arguments. Throws std::runtime_error when none is found (never seen).
[[nodiscard]] CrowdedWorkload make_chain(std::size_t arms, std::size_t jobs, bool after,
                                         std::uint64_t seed);

}  // namespace armloom
