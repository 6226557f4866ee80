#pragma once

#include <optional>
#include <string>

#include "core/jobs/state.h"

namespace armloom {

// Returns one sentence about a violated invariant; nullopt if all hold after a step:
//
// - For every admitted motion, 0 <= progress <= authority <= duration. Its job is admitted, moving,
//   braking or held.
// - A job that moves, brakes or is held is the first in the queues of its arms. A job that moves or
//   brakes has its motion in the precedence graph.
// - For two motions A and B with progress s and authority alpha, the rectangle [s_A, alpha_A] x
//   [s_B, alpha_B] meets none of their conflict regions.
//
// Asserted in every build, except after steps that only report progress. Takes time linear in the
// admitted motions and the boxes of their regions. Two other checks throw std::logic_error: of
// phase transitions (JobBook::enter) and of grants beyond the orders (PrecedenceGraph::granted).
// Only tests check that the orders are acyclic (PrecedenceGraph::is_acyclic).
[[nodiscard]] std::optional<std::string> broken_invariant(const State& state);

}  // namespace armloom
