#pragma once

#include "core/executive/authority_gate.h"
#include "core/executive/motions.h"
#include "core/monitor/observation.h"

namespace armloom {

// Returns what the monitor may know: the last reports of all arms, and their authority.
[[nodiscard]] Observation observed(const Motions& motions, const AuthorityGate& gate,
                                   std::size_t arms, TimePoint now);

}  // namespace armloom
