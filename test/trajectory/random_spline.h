#pragma once

#include <random>

#include "core/trajectory/validate.h"

namespace armloom::testing {

inline double uniform(std::mt19937_64& random, double from, double to) {
  return std::uniform_real_distribution<double>(from, to)(random);
}

struct SplineScale {
  double reach;                  // of positions, velocities, accelerations
  double shortest_s, longest_s;  // of a segment
};

// Returns one to five cubic or quintic segments of the arm "pair", with zero velocity at both ends.
inline TrajectoryRequest random_spline(std::mt19937_64& random, const SplineScale& scale,
                                       bool quintic) {
  TrajectoryRequest request{{"pair_a", "pair_b"}, {}};
  const int count = std::uniform_int_distribution<int>(2, 6)(random);
  double time_s = 0.0;
  for (int k = 0; k < count; ++k) {
    const bool end = k == 0 || k + 1 == count;
    WaypointRequest point;
    for (int j = 0; j < 2; ++j) {
      point.positions.push_back(uniform(random, -scale.reach, scale.reach));
      point.velocities.push_back(end ? 0.0 : uniform(random, -scale.reach, scale.reach));
      if (quintic) point.accelerations.push_back(uniform(random, -scale.reach, scale.reach));
    }
    point.time_from_start_s = time_s;
    request.points.push_back(point);
    time_s += uniform(random, scale.shortest_s, scale.longest_s);
  }
  return request;
}

}  // namespace armloom::testing
