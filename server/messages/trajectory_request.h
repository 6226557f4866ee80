#pragma once

#include "core/trajectory/validate.h"
#include "server/codec/format.h"

namespace armloom {

// trajectory_msgs/JointTrajectory, or MoveIt's nesting ({"joint_trajectory": {...}}). Shape only;
// validate() checks names, sizes, limits and times.
[[nodiscard]] FormatPtr<TrajectoryRequest> trajectory_request_format();
// For answers; the schema is that of requests.
[[nodiscard]] FormatPtr<TrajectoryRequest> told_trajectory_format();

}  // namespace armloom
