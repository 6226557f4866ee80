#pragma once

#include <cstddef>

#include "core/coordination/motion.h"
#include "test/bench/motions.h"

namespace armloom::bench {

// The workloads of the benchmarks with motions, each found once by seed_search.cc and checked
// against exact shapes when made: std::runtime_error says what no longer holds.

// The arms stay more than 0.15 m apart at all times, more than 0.10 m with either up to 0.5 s
// ahead.
[[nodiscard]] Motions clear_pair();

// The arms pass through each other's places (were they to stand anywhere on their ways, they would
// touch), 45 to 55 mm apart at the closest; with either up to kCrossingBand ahead they keep 40 mm.
inline constexpr Duration kCrossingBand = std::chrono::milliseconds(300);
[[nodiscard]] Motions crossing_pair();

// A hall with `others` arms that run and one more, the candidate, in their middle: only its
// neighbours are within its reach. All motions begin together and are clear of each other by 0.05 m
// with any of two neighbours up to 0.5 s ahead. others: 1, 3, 7, 15.
struct Hall {
  Motions motions;        // by arm
  std::size_t candidate;  // index of its motion and arm
};
[[nodiscard]] Hall hall(std::size_t others);

// The admission of motion `candidate` beside the others, all at progress zero, as a Question.
[[nodiscard]] Question admission(const Motions& motions, std::size_t candidate,
                                 const CheckMethod& method);

}  // namespace armloom::bench
