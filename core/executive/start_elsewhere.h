#pragma once

#include "core/base/problem.h"
#include "core/model/cell.h"
#include "core/trajectory/trajectory.h"

namespace armloom {

// Every joint of the motion that does not begin (within the tolerance) where `rest` has it;
// pointers below the trajectory.
void find_start_elsewhere(const Cell& cell, const Trajectory& trajectory, const Configuration& rest,
                          Problems& problems);

}  // namespace armloom
