#pragma once

#include <optional>

#include "core/base/problem.h"
#include "core/executive/job_request.h"
#include "core/model/cell.h"
#include "core/trajectory/trajectory.h"

namespace armloom {

// Returns true if the request's goal moves only the gripper of one arm: it names positions of
// gripper joints, or a state of the SRDF that does, and that is no state of the arm itself.
[[nodiscard]] bool moves_gripper_only(const JobRequest& request, const Cell& cell);

// Returns the motion for such a goal: a straight line of the gripper joints from `rest`, while the
// arm stays. Problems, with pointers into the request:
// - "unknown-arm" at "/arm",
// - "unknown-joint" and "limit-exceeded" at "/move_to/joints/NAME",
// - those of joint_line() if the arm rests outside its limits.
[[nodiscard]] Result<TrajectoryPtr> gripper_motion(const JobRequest& request, const Cell& cell,
                                                   const Configuration& rest);

}  // namespace armloom
