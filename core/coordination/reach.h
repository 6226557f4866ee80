#pragma once

#include "core/base/ids.h"
#include "core/base/time.h"
#include "core/model/cell.h"
#include "core/trajectory/trajectory.h"

namespace armloom {

// The configurations that one arm may reach: a stretch of a motion, shifted by `shift`, with each
// joint at most `error` away. Joints that the motion does not move stay at `rest`, also shifted and
// with the error. All configurations have one entry per joint of the cell (rad, m).
struct Reach {
  ArmId arm;
  TrajectoryPtr motion = {};  // null if the arm has none
  Duration from{}, to{};      // 0 <= from <= to <= duration
  Configuration rest;
  Configuration shift;
  Configuration error;  // >= 0
  // Bounds of the progress at each time t from now on, counted from `from`: at least
  // rate_low * t - slack - late, at most rate_high * t + slack.
  double rate_low = 0.0;
  double rate_high = 1.0;
  Duration slack{};
  Duration late{};

  [[nodiscard]] bool moves() const { return motion && from < to; }
};

}  // namespace armloom
