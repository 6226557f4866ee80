#pragma once

#include "core/trajectory/validate.h"
#include "server/codec/format.h"

namespace armloom {

// Describes trajectory_msgs/JointTrajectory, or MoveIt's nesting ({"joint_trajectory": {...}}).
// Reading checks only the structure; validate() checks names, sizes, limits and times.
[[nodiscard]] FormatPtr<TrajectoryRequest> trajectory_request_format();
// Describes a trajectory in an answer. Its schema is the schema of a trajectory in a request.
[[nodiscard]] FormatPtr<TrajectoryRequest> told_trajectory_format();

}  // namespace armloom
