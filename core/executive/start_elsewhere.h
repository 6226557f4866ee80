#pragma once

#include "core/base/problem.h"
#include "core/model/cell.h"
#include "core/trajectory/trajectory.h"
#include "core/trajectory/validate.h"

namespace armloom {

// Returns the motion with its continuous joints moved by the whole turns that bring its start to
// `rest`, within execution.start_tolerance_rad. Joints that this does not bring there are
// unchanged.
[[nodiscard]] TrajectoryPtr with_whole_turns(const Cell& cell, TrajectoryPtr motion,
                                             const Configuration& rest);

// Adds a problem for each joint of the motion whose start differs from `rest` by more than
// execution.start_tolerance_rad. Pointers are relative to the trajectory. A move-to-start moves the
// joints of arms, but no gripper joints, so these are compared in any case.
enum class Compared { all_joints, gripper_joints };
void find_start_elsewhere(const Cell& cell, const Trajectory& trajectory, const Configuration& rest,
                          Problems& problems, Compared compared = Compared::all_joints);
// Does this for the first waypoint of a request that is not valid.
void find_start_elsewhere(const Cell& cell, const TrajectoryRequest& request,
                          const Configuration& rest, Problems& problems);

}  // namespace armloom
