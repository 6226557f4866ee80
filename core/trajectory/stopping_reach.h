#pragma once

#include "core/model/cell.h"
#include "core/trajectory/trajectory.h"

namespace armloom {

// Returns the longest trajectory time (s) that a motion passes from a brake command until it rests
// on its path. This holds for a brake at any position, and at any rate up to the planned rate.
// Braking uses each joint's `brake`, minus the acceleration that the path itself needs. With the
// rate r = ds/dt,
//   |q'_j s'' + q''_j r^2| <= brake_j  allows  -s'' = min_j (brake_j - |q''_j|) / |q'_j|,
// with bounds over all segments that can still be passed. The distance is then at most
//   1 / (2 |s''|).
// The result is at most the motion's duration.
[[nodiscard]] double stopping_reach_s(const Cell& cell, const Trajectory& trajectory);

}  // namespace armloom
