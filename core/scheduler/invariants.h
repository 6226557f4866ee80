#pragma once

#include <optional>
#include <string>

#include "core/scheduler/state.h"

namespace armloom {

// What has to hold after every step, and does not: one sentence; nothing: all holds.
//
//   Of every admitted motion: 0 <= progress <= authority <= duration, and its job is admitted, in
//   motion, braking or held. What moves, brakes or is held is the first of its arms.
//   No rectangle of authority, [s_A, alpha_A] x [s_B, alpha_B], meets a region of the two.
//   Orders are acyclic: predicted as things stand, nobody waits in a ring.
//   An arm has one motion at most; a job that has ended is in no queue.
//
// Besides, at any time: transitions of phases are those of the table (JobBook::enter), authority is
// granted no farther than orders let it (PrecedenceGraph::granted); both throw std::logic_error.
[[nodiscard]] std::optional<std::string> broken_invariant(const State& state);

}  // namespace armloom
