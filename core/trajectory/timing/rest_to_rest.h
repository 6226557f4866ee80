#pragma once

#include <vector>

#include "core/base/time.h"

namespace armloom {

// A jerk-limited motion of one coordinate s from 0 to 1 in the least time, at rest (velocity and
// acceleration zero) at both ends: the double-S profile (Biagiotti and Melchiorri, "Trajectory
// Planning for Automatic Machines and Robots", 3.4). Jerk is constant between knots, so the quintic
// between two neighboring knots equals s.
struct ProfileKnot {
  Duration time;
  double s;
  double velocity;      // 1/s
  double acceleration;  // 1/s^2
};
struct ProfileRates {  // of s: 1/s, 1/s^2, 1/s^3; > 0, not all infinite
  double velocity;
  double acceleration;
  double jerk;
};

// Returns knots on whole nanoseconds, the first at zero. The duration of each phase is rounded up,
// and the rates are lowered so that s ends at 1. So no limit is exceeded, up to rounding of
// doubles. Phases of changing acceleration take at least kJerkPhaseMin: shorter phases would be
// lost in the rounding of positions.
inline constexpr Duration kJerkPhaseMin = std::chrono::milliseconds(1);
[[nodiscard]] std::vector<ProfileKnot> rest_to_rest(const ProfileRates& rates);

}  // namespace armloom
