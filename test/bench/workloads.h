#pragma once

#include <cstddef>

#include "core/coordination/motion.h"
#include "test/bench/motions.h"

namespace armloom::bench {

// The workloads with motions, each found once by seed_search.cc and checked against exact shapes
// when created. Throw std::runtime_error with the violated claim.

// The arms stay more than 0.15 m apart at all times, and more than 0.10 m with either arm up to 0.5
// s ahead.
[[nodiscard]] Motions clear_pair();

// The arms pass through each other's space (resting on each other's path they would touch), 45 to
// 55 mm apart at the closest. With either arm up to kCrossingBand ahead they keep 40 mm.
inline constexpr Duration kCrossingBand = std::chrono::milliseconds(300);
[[nodiscard]] Motions crossing_pair();

// A hall with `others` running arms and one candidate arm in the middle, which reaches only its
// neighbors. All motions start together and are clear of each other by 0.05 m, with either of two
// neighbors up to 0.5 s ahead. others: 1, 3, 7, 15.
struct Hall {
  Motions motions;        // by arm
  std::size_t candidate;  // index of its motion and arm
};
[[nodiscard]] Hall hall(std::size_t others);

// Returns the Question for admitting motion `candidate` alongside the others, all at progress zero.
[[nodiscard]] Question admission(const Motions& motions, std::size_t candidate,
                                 const CheckMethod& method);

}  // namespace armloom::bench
