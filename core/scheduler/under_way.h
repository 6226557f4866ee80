#pragma once

#include <vector>

#include "core/coordination/motion.h"
#include "core/jobs/state.h"

namespace armloom {

// Makes jobs of motions that are under way already, each at its progress, as if all had been
// admitted without a question; under policies with rounds they are one. Preconditions: nothing else
// is there; at most one of an arm; their ids grow.
void put_under_way(State& state, const std::vector<Motion>& motions);

}  // namespace armloom
