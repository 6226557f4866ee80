#pragma once

#include "core/trajectory/validate.h"
#include "server/codec/format.h"

namespace armloom {

// A trajectory as ROS's tools print it: trajectory_msgs/JointTrajectory, or one level deeper as
// MoveIt has it ({"joint_trajectory": {...}}). Its shape only; names, sizes, limits and times are
// validate()'s.
[[nodiscard]] FormatPtr<TrajectoryRequest> trajectory_request_format();
// As the server tells one: what is said is what may be posted, so there is one schema for both.
[[nodiscard]] FormatPtr<TrajectoryRequest> told_trajectory_format();

}  // namespace armloom
