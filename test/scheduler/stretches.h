#pragma once

#include <vector>

#include "core/trajectory/trajectory.h"

namespace armloom {

// Positions of an arm (rad), from <= to.
struct Stretch {
  double from, to;
};
struct Span {
  Duration from, to;
};

[[nodiscard]] double place_of(const Trajectory& motion, ArmId arm, Duration progress);
// Returns when the arm is in the stretch: one span for each line of the motion, a microsecond
// longer at either end. Lines go from rest to rest (bench_cell.h).
[[nodiscard]] std::vector<Span> spans_in(const Trajectory& motion, ArmId arm, Stretch stretch);

}  // namespace armloom
