#pragma once

#include <vector>

#include "core/trajectory/timing/joint_path.h"
#include "core/trajectory/timing/joint_rates.h"

namespace armloom {

// How to go along a path: between two neighbouring stations the acceleration s'' is constant.
struct Station {
  double s;
  double speed;         // s'
  double time_s;        // from the beginning
  std::size_t piece;    // of the path, from here on; of the last station the last one
  double acceleration;  // s'' from here on; of the last station 0
};

// The fastest way along the path from rest to rest that keeps the velocity and acceleration of each
// joint (jerk is not read) on each piece cut in `cuts` (at least) parts, by reachability: Pham and
// Pham, "A New Approach to Time-Optimal Path Parameterization Based on Reachability Analysis", IEEE
// T-RO 2018. From the end backwards, the largest x = s'^2 of each station from which the rest can
// still be kept; from the beginning forwards, the largest x that leads there. Within a part
//   q'' = q_s s'' + q_ss x,   x linear in s:
// a polynomial of s whose Bernstein coefficients are linear in (x, s''); these are held within the
// limits, so that the limits are kept at every instant and not at stations only.
[[nodiscard]] std::vector<Station> fastest_along(const JointPath& path, const JointRates& rates,
                                                 std::size_t parts);

}  // namespace armloom
