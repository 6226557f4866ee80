#pragma once

#include <optional>
#include <string>

#include "core/jobs/state.h"

namespace armloom {

// Returns one sentence about a violated invariant; nullopt if all hold after a step:
//
// - Of every admitted motion: 0 <= progress <= authority <= duration, and its job is admitted,
//   moving, braking or held.
// - A job that moves, brakes or is held is the first of its arms; one that moves or brakes is
//   admitted.
// - No rectangle of authority, [s_A, alpha_A] x [s_B, alpha_B], meets a conflict region of the two.
//
// Asserted in every build. Linear in the admitted motions and the boxes of their regions. Other
// checks that throw std::logic_error: phase transitions (JobBook::enter) and grants beyond the
// orders (PrecedenceGraph::granted). Tests assert that the orders are acyclic
// (PrecedenceGraph::is_acyclic).
[[nodiscard]] std::optional<std::string> broken_invariant(const State& state);

}  // namespace armloom
