#pragma once

#include <vector>

#include "core/base/time.h"

namespace armloom {

// A jerk-limited motion of one coordinate s from 0 to 1, at rest (velocity and acceleration zero)
// at both ends, in the least time: the double-S profile (Biagiotti and Melchiorri, "Trajectory
// Planning for Automatic Machines and Robots", 3.4, with both end velocities zero). Between two of
// its knots the jerk is constant, so that the quintic through their states is s itself.
struct ProfileKnot {
  Duration time;
  double s;
  double velocity;      // 1/s
  double acceleration;  // 1/s^2
};
struct ProfileRates {  // of s: 1/s, 1/s^2, 1/s^3; > 0, may be infinite but not all
  double velocity;
  double acceleration;
  double jerk;
};

// Knots lie on whole nanoseconds and the first is at zero; each phase of the profile is rounded up
// to that, and its rates lowered so that it still ends in 1: never above a limit, but for rounding
// of doubles. No phase of changing acceleration is shorter than kJerkPhaseMin: what is made of
// shorter ones would be lost in the rounding of positions.
inline constexpr Duration kJerkPhaseMin = std::chrono::milliseconds(1);
[[nodiscard]] std::vector<ProfileKnot> rest_to_rest(const ProfileRates& rates);

}  // namespace armloom
