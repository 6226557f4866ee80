#pragma once

#include <vector>

#include "core/trajectory/trajectory.h"

namespace armloom {

// A stretch of an arm's places (rad), from <= to.
struct Stretch {
  double from, to;
};
struct Span {
  Duration from, to;
};

// Where the arm of this motion is at `progress` (rad).
[[nodiscard]] double place_of(const Trajectory& motion, ArmId arm, Duration progress);
// When the arm is in the stretch, line by line: a microsecond longer on either side. The motion
// goes from rest to rest on each (`move` and `visit` of bench_cell.h).
[[nodiscard]] std::vector<Span> spans_in(const Trajectory& motion, ArmId arm, Stretch stretch);

}  // namespace armloom
