#pragma once

#include <vector>

#include "core/base/ids.h"
#include "core/base/time.h"
#include "core/model/cell.h"
#include "core/trajectory/trajectory.h"

namespace armloom {

// The joint that is farthest from a path, at the progress where the largest distance is smallest.
struct PathDistance {
  double distance = 0.0;  // rad, m
  JointId joint{0};
  Duration progress{};
};
// Returns how far the arm's joints are from one common point of the motion between the progress
// `from` and `to`. At most `enough` if such a point exists; else exact to 1 %. `joints`: joints of
// the arm; those that the motion does not move are ignored. Pure.
[[nodiscard]] PathDistance distance_from_path(const Trajectory& motion,
                                              const std::vector<JointId>& joints, Duration from,
                                              Duration to, const Configuration& measured,
                                              double enough);

}  // namespace armloom
