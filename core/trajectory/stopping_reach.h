#pragma once

#include "core/model/cell.h"
#include "core/trajectory/trajectory.h"

namespace armloom {

// How much trajectory time a motion passes at most from the command to brake until it rests on its
// path, wherever and at whatever rate up to the planned one it is told (s). Braking uses each
// joint's `brake`, less what the path itself takes: with the rate r = ds/dt,
//   |q'_j s'' + q''_j r^2| <= brake_j  allows  -s'' = min_j (brake_j - |q''_j|) / |q'_j|,
// from the bounds of the segments that it can still pass; then the way is at most 1 / (2 |s''|). At
// most the duration.
[[nodiscard]] double stopping_reach_s(const Cell& cell, const Trajectory& trajectory);

}  // namespace armloom
