#pragma once

#include <vector>

#include "core/trajectory/timing/path_speed.h"
#include "core/trajectory/validate.h"

namespace armloom {

// The motion q(t) along a path, averaged over a time window:
//   q~(t) = 1/T  integral of q over [t - T/2, t + T/2],  at rest before and after the motion.
// (Biagiotti and Melchiorri, "FIR filters for online trajectory planning with time- and
// frequency-domain specifications", Control Engineering Practice 2012.) Velocity and acceleration
// of q~ are means of those of q, so they are no larger. The jerk of q~ is
//   |q''(t + T/2) - q''(t - T/2)| / T <= 2 a_max / T.
// The acceleration is zero at both ends. The motion takes T longer than q, and no joint leaves the
// path by more than a_max T^2 / 24.
//
// Returns waypoints with velocities and accelerations, the first at time zero. The quintics between
// waypoints equal q~ unless its jerk jumps in between. So there are waypoints where the jerk jumps:
// half a window before and after each station. A station at which accelerations change by less than
// kSmallJump of their limits has a single waypoint. Of several waypoints within half a millisecond,
// a single waypoint is kept. Precondition: window_s > 0.
inline constexpr double kSmallJump = 0.03;
[[nodiscard]] std::vector<WaypointRequest> softened(const JointPath& path, const JointRates& rates,
                                                    const std::vector<Station>& stations,
                                                    double window_s);

}  // namespace armloom
