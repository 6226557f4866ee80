#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/coordination/motion.h"

namespace armloom::soundness {

// Pairs of motions with a clearance of kCloseClearance_m that stay undecided (open) at the highest
// effort (core/coordination/effort.h). Under Coordinated a pair is open if it has a region in which
// no conflict is proven.
struct OpenPair {
  std::size_t pair;
  double keeps_m;  // smallest distance found near the open states
};
struct OpenPairs {
  std::size_t pairs = 0;
  std::size_t free = 0;
  std::size_t conflict = 0;
  std::vector<OpenPair> open;
  double evaluations_mean = 0.0;
  std::uint64_t evaluations_max = 0;  // over all questions about a pair
};
inline constexpr double kCloseClearance_m = 0.005;
inline constexpr double kHardly_m = 0.002;  // open pairs keep less than the clearance plus this
[[nodiscard]] OpenPairs find_open(std::size_t pairs, std::uint64_t seed, const CheckMethod& method);

}  // namespace armloom::soundness
