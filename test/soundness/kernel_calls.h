#pragma once

#include <vector>

#include "core/collision/filter/kernel.h"

namespace armloom::soundness {

// Every pair is looked at: also where kernels can skip groups of pairs, none are named.
template <class Kernel>
int near_pairs(const Kernel& kernel, const filter::Side& a, const filter::Side& b,
               const std::vector<filter::Pair>& pairs, unsigned lanes, filter::Hit* hits) {
  const int count = static_cast<int>(pairs.size());
  if constexpr (requires { kernel.near_pairs(a, b, pairs.data(), count, lanes, hits); }) {
    return kernel.near_pairs(a, b, pairs.data(), count, lanes, hits);
  } else {
    return kernel.near_pairs(a, b, pairs.data(), count, nullptr, 0, lanes, hits);
  }
}

}  // namespace armloom::soundness
