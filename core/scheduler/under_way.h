#pragma once

#include <vector>

#include "core/coordination/motion.h"
#include "core/jobs/transitions.h"

namespace armloom {

// Adds jobs whose motions are under way, each at its progress, and admits them without a check.
// Under policies with rounds they form one round. Preconditions: the state has no other jobs; at
// most one motion per arm; their ids grow.
void put_under_way(Transitions& state, const std::vector<Motion>& motions);

}  // namespace armloom
