#pragma once

#include <vector>

#include "core/trajectory/timing/joint_path.h"
#include "core/trajectory/timing/joint_rates.h"

namespace armloom {

// The speed at one place of a path. s'' is constant between neighboring stations.
struct Station {
  double s;
  double speed;         // s'
  double time_s;        // since the beginning
  std::size_t piece;    // piece of the path from here on; at the end, the last piece
  double acceleration;  // s'' from here on; 0 at the end
};

// Returns the fastest speeds along the path from rest to rest within each joint's velocity and
// acceleration (jerk is ignored). Cuts the path into at least `parts` parts. Method: Pham and Pham,
// "A New Approach to Time-Optimal Path Parameterization Based on Reachability Analysis", IEEE T-RO
// 2018. A backward pass computes for each station the largest x = s'^2 from which the motion can
// come to rest at the end within the limits. A forward pass then takes at each station the largest
// possible x up to this bound. Within a part, s'' is constant and
//   q'' = q_s s'' + q_ss x,   x linear in s,
// is a polynomial of s whose Bernstein coefficients are linear in (x, s''). These coefficients are
// kept within the limits, so the limits hold at every instant, not only at stations.
[[nodiscard]] std::vector<Station> fastest_along(const JointPath& path, const JointRates& rates,
                                                 std::size_t parts);

}  // namespace armloom
