#pragma once

#include <vector>

#include "core/coordination/motion.h"
#include "core/jobs/state.h"

namespace armloom {

// Adds jobs for motions that are under way, each at its progress, as if admitted without a
// question; under policies with rounds they form one round. Preconditions: the state has no other
// jobs; at most one motion per arm; their ids grow.
void put_under_way(State& state, const std::vector<Motion>& motions);

}  // namespace armloom
