#pragma once

#include <vector>

#include "core/collision/filter/kernel.h"

namespace armloom::soundness {

// Every pair is looked at: no groups of pairs are named that could be skipped.
inline int near_pairs(const filter::Kernel& kernel, const filter::Side& a, const filter::Side& b,
                      const std::vector<filter::Pair>& pairs, unsigned lanes, filter::Hit* hits) {
  return kernel.near_pairs(a, b, pairs.data(), static_cast<int>(pairs.size()),
                           filter::Groups{nullptr, 0, false}, lanes, hits);
}

}  // namespace armloom::soundness
