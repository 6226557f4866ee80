#pragma once

#include <vector>

#include "core/model/cell.h"
#include "core/trajectory/trajectory.h"

namespace armloom {

// Where an arm could go to make way, in the order in which it is tried: back along the motion that
// brought it here (null: none), which is certified against the scene, or, where it stopped on the
// way of that, straight joint lines to its start and its goal; then lines to its home and to the
// named poses of its group. From where it stands in `rest` (whole cell); poses where it stands
// already are left out. Pure.
[[nodiscard]] std::vector<TrajectoryPtr> ways_aside(const Cell& cell, ArmId arm,
                                                    const Configuration& rest,
                                                    const TrajectoryPtr& came_by);

}  // namespace armloom
