#pragma once

#include <vector>

#include "core/trajectory/timing/path_speed.h"
#include "core/trajectory/validate.h"

namespace armloom {

// The motion q(t) along a path, each instant replaced by its mean over a window of time, half of it
// before and half after:
//   q~(t) = 1/T  integral of q over [t - T/2, t + T/2],  at rest before and after the motion.
// (A moving average: Biagiotti and Melchiorri, "FIR filters for online trajectory planning with
// time- and frequency-domain specifications", Control Engineering Practice 2012.) Its velocity and
// acceleration are means of those of q, so no larger than what q keeps; its jerk is
// |q''(t + T/2) - q''(t - T/2)| / T <= 2 a_max / T; the acceleration is zero at both ends; it takes
// T longer, and is no farther from the path than a_max T^2 / 24 in each joint.
//
// Waypoints with velocities and accelerations, the first at time zero: the quintics between them
// are q~ but for what a jump of the jerk between two waypoints leaves. They lie where the jerk
// jumps, half a window before and after each station; where the acceleration changes there by less
// than kSmallJump of what the joints may have, one at the station does, and of two that are closer
// than half a millisecond one. Precondition: window_s > 0.
inline constexpr double kSmallJump = 0.03;
[[nodiscard]] std::vector<WaypointRequest> softened(const JointPath& path, const JointRates& rates,
                                                    const std::vector<Station>& stations,
                                                    double window_s);

}  // namespace armloom
