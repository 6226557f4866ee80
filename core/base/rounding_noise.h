#pragma once

#include <cmath>

namespace armloom {

// Rounds a joint position (rad or m) for display: 0, not 6.9e-18.
[[nodiscard]] inline double without_rounding_noise(double q) {
  return std::abs(q) < 1e-9 ? 0.0 : q;
}

}  // namespace armloom
