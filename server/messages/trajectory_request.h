#pragma once

#include "core/trajectory/validate.h"
#include "server/codec/format.h"
#include "server/codec/member_part.h"
#include "server/codec/part_groups.h"
#include "server/codec/value_formats.h"

namespace armloom {

// Describes trajectory_msgs/JointTrajectory, MoveIt's nesting ({"joint_trajectory": {...}}), or a
// list of one of these. Reading checks only the structure; validate() checks names, sizes, limits
// and times. Sets TrajectoryRequest::place to the pointer from the document's root.
[[nodiscard]] FormatPtr<TrajectoryRequest> trajectory_request_format();
// Describes a goal of control_msgs/FollowJointTrajectory.
[[nodiscard]] FormatPtr<TrajectoryRequest> action_goal_format();
// The members of a trajectory, and of MoveIt's nesting, for an object that has other members too.
// bare_trajectory_parts() does not set TrajectoryRequest::place.
[[nodiscard]] formats::PartPtr<TrajectoryRequest> bare_trajectory_parts();
[[nodiscard]] formats::PartPtr<TrajectoryRequest> bare_robot_trajectory_parts();

// A ROS 2 time, a ROS 1 time, or a number of seconds.
[[nodiscard]] FormatPtr<double> time_format();
// Tolerances as in control_msgs/FollowJointTrajectory, none of which may bound anything.
[[nodiscard]] FormatPtr<formats::Anything> no_tolerances();
[[nodiscard]] FormatPtr<formats::Anything> no_time_tolerance();
template <class T>
[[nodiscard]] formats::PartPtr<T> tolerance_parts() {
  constexpr const char* kText = "As in FollowJointTrajectory. Not watched for one job: 0 or less";
  using formats::ignored;
  return formats::parts<T>({
      ignored<T>("path_tolerance", no_tolerances(), kText),
      ignored<T>("component_path_tolerance", no_tolerances(), kText),
      ignored<T>("goal_tolerance", no_tolerances(), kText),
      ignored<T>("component_goal_tolerance", no_tolerances(), kText),
      ignored<T>("goal_time_tolerance", no_time_tolerance(), kText),
  });
}

// Describes a trajectory in an answer. Its schema is the schema of a trajectory in a request.
[[nodiscard]] FormatPtr<TrajectoryRequest> told_trajectory_format();

}  // namespace armloom
