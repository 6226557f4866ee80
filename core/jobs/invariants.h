#pragma once

#include <optional>
#include <string>

#include "core/jobs/state.h"

namespace armloom {

// What has to hold after every step, and does not: one sentence; nothing: all holds.
//
//   Of every admitted motion: 0 <= progress <= authority <= duration, and its job is admitted, in
//   motion, braking or held. What moves, brakes or is held is the first of its arms, and admitted.
//   No rectangle of authority, [s_A, alpha_A] x [s_B, alpha_B], meets a region of the two.
//
// Linear in what is admitted, and in the boxes of its regions: asserted in every build. Besides, at
// any time: phases follow as their table says (JobBook::enter), authority is granted no farther
// than orders let it (PrecedenceGraph::granted). All throw std::logic_error. That orders are
// acyclic (PrecedenceGraph::is_acyclic) is asserted in tests.
[[nodiscard]] std::optional<std::string> broken_invariant(const State& state);

}  // namespace armloom
