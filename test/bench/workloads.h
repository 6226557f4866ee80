#pragma once

#include <cstddef>

#include "core/coordination/motion.h"
#include "test/bench/motions.h"

namespace armloom::bench {

// Motions found by seed_search.cc and checked with exact shapes. A std::runtime_error names the
// violated claim.

// The arms stay more than 0.15 m apart. With either motion up to 0.5 s ahead they stay more than
// 0.10 m apart.
[[nodiscard]] Motions clear_pair();

// The arms pass through each other's space, 45 to 55 mm apart at the closest. With either motion up
// to kCrossingBand ahead they keep 40 mm.
inline constexpr Duration kCrossingBand = std::chrono::milliseconds(300);
[[nodiscard]] Motions crossing_pair();

// One candidate in the middle and `others` running arms (1, 3, 7 or 15). The candidate reaches only
// its neighbors. All motions start together. They keep 0.05 m, even with either of two neighbors up
// to 0.5 s ahead.
struct Hall {
  Motions motions;        // by arm
  std::size_t candidate;  // index of its motion and arm
};
[[nodiscard]] Hall hall(std::size_t others);

// Returns the Question for admitting motion `candidate`, all at progress zero.
[[nodiscard]] Question admission(const Motions& motions, std::size_t candidate,
                                 const CheckMethod& method);

}  // namespace armloom::bench
