#pragma once

#include "core/model/cell.h"
#include "core/trajectory/trajectory.h"

namespace armloom {

// Returns the most trajectory time (s) that a motion passes from the brake command until it rests
// on its path, from any position and any rate up to the planned rate. Braking uses each joint's
// `brake`, less what the path itself takes: with the rate r = ds/dt,
//   |q'_j s'' + q''_j r^2| <= brake_j  allows  -s'' = min_j (brake_j - |q''_j|) / |q'_j|,
// from the bounds of the segments that can still be passed; then the distance is at most 1 / (2
// |s''|). At most the duration.
[[nodiscard]] double stopping_reach_s(const Cell& cell, const Trajectory& trajectory);

}  // namespace armloom
