#pragma once

#include <cstddef>
#include <vector>

#include "core/base/problem.h"
#include "core/model/cell.h"
#include "core/trajectory/validate.h"

namespace armloom {

// A request with more waypoints must name its start, because it is completed on the control strand.
inline constexpr std::size_t kImplicitStartWaypointsMax = 1000;

// Returns true if the request leaves its start to the position that its arms will have then:
// - it has a single waypoint, or the time of its first waypoint is above 0: as in ROS's
//   joint_trajectory_controller, the motion leads from the arms' position to this waypoint
//   (without `retime`, which ignores times, if there are several);
// - or of some arm it names only gripper joints: the arm stays where it will be.
// validate() refuses such a request; with_implicit_start() completes it first. Thread-safe.
[[nodiscard]] bool has_implicit_start(const TrajectoryRequest& request, const Cell& cell);

// Returns the arms whose position the request depends on. Unknown joints are left out.
[[nodiscard]] std::vector<ArmId> arms_of(const TrajectoryRequest& request, const Cell& cell);

// Completes a request that has_implicit_start(), from the position `rest` of all joints: adds the
// start as a waypoint at rest with time 0, and the joints of arms that stay. A single waypoint
// within the cell's start tolerance, without a time that counts, becomes a motion that rests there
// for kLineMin: the arm is already there. Elsewhere the time is missing ("no-time" at
// "/points/0/time_from_start") unless the request has `retime`. Thread-safe.
[[nodiscard]] Result<TrajectoryRequest> with_implicit_start(TrajectoryRequest request,
                                                            const Cell& cell,
                                                            const Configuration& rest);

// Validates a request that may have an implicit start, from the position `rest` of all joints.
// Thread-safe.
[[nodiscard]] Result<TrajectoryPtr> validate_from(const TrajectoryRequest& request,
                                                  const Cell& cell, const Configuration& rest);

}  // namespace armloom
