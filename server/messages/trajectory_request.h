#pragma once

#include "core/trajectory/validate.h"
#include "server/codec/format.h"

namespace armloom {

// Describes trajectory_msgs/JointTrajectory, or MoveIt's nesting ({"joint_trajectory": {...}}).
// Only the shape is checked; validate() checks names, sizes, limits and times.
[[nodiscard]] FormatPtr<TrajectoryRequest> trajectory_request_format();
// Describes a trajectory in an answer; the schema is that of requests.
[[nodiscard]] FormatPtr<TrajectoryRequest> told_trajectory_format();

}  // namespace armloom
