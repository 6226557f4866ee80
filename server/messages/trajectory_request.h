#pragma once

#include "core/trajectory/validate.h"
#include "server/codec/format.h"

namespace armloom {

// A trajectory in the form of trajectory_msgs/JointTrajectory, or nested as in MoveIt
// ({"joint_trajectory": {...}}). Only the shape is checked; validate() checks names, sizes, limits
// and times.
[[nodiscard]] FormatPtr<TrajectoryRequest> trajectory_request_format();
// The trajectory format of answers; its schema is that of requests.
[[nodiscard]] FormatPtr<TrajectoryRequest> told_trajectory_format();

}  // namespace armloom
