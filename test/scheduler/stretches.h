#pragma once

#include <vector>

#include "core/trajectory/trajectory.h"

namespace armloom {

// An interval of an arm's positions (rad), from <= to.
struct Stretch {
  double from, to;
};
struct Span {
  Duration from, to;
};

// Returns the arm's position at `progress` of this motion (rad).
[[nodiscard]] double place_of(const Trajectory& motion, ArmId arm, Duration progress);
// Returns when the arm is in the stretch, one span per line, a microsecond longer on either side.
// Each line of the motion must go from rest to rest (`move` and `visit` of bench_cell.h).
[[nodiscard]] std::vector<Span> spans_in(const Trajectory& motion, ArmId arm, Stretch stretch);

}  // namespace armloom
