#pragma once

#include "core/model/promises.h"
#include "core/trajectory/trajectory.h"

namespace armloom {

// Arms of one synchronous motion keep in step: an arm ahead of another by more than
// Promises::out_of_step is ordered to wait. So their progress differs by at most the sum of this
// lead and the stopping reach (core/trajectory/stopping_reach.h). All values are trajectory time.
// - out_of_step: the lead at which the order is given
// - until_told: age of the progress on which the order rests
[[nodiscard]] inline Duration lead_max(const Cell& cell, const Trajectory& motion) {
  const Promises promises = promises_of(cell, motion.arms());
  return promises.out_of_step() + promises.until_told();
}
[[nodiscard]] inline Duration out_of_step(const Cell& cell, const Trajectory& motion) {
  return promises_of(cell, motion.arms()).out_of_step();
}

}  // namespace armloom
