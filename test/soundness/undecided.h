#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/coordination/motion.h"

namespace armloom::soundness {

// What the check leaves open of random pairs of motions of two Pandas that have to keep
// kCloseClearance_m only, with all the effort there is (core/coordination/effort.h). Of
// Coordinated: pairs with a region in which no conflict is proven.
struct OpenPair {
  std::size_t pair;
  double keeps_m;  // with every deviation that was tried, about where it is open
};
struct OpenPairs {
  std::size_t pairs = 0;
  std::size_t free = 0;
  std::size_t conflict = 0;
  std::vector<OpenPair> open;
  double evaluations_mean = 0.0;
  std::uint64_t evaluations_max = 0;  // for all askings of a pair
};
inline constexpr double kCloseClearance_m = 0.005;
inline constexpr double kHardly_m = 0.002;  // what is open keeps less than this above it
[[nodiscard]] OpenPairs find_open(std::size_t pairs, std::uint64_t seed, const CheckMethod& method);

}  // namespace armloom::soundness
