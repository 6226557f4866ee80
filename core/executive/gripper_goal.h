#pragma once

#include <map>
#include <string>

#include "core/base/problem.h"
#include "core/executive/job_request.h"
#include "core/executive/task_request.h"
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

// Returns the positions of the arm's gripper joints at this width (m). The fingers are links that
// gripper joints move in a straight line; each joint of several moves as far as the others.
// Problems, with pointers into the step:
// - "unknown-arm" at "/gripper/arm"
// - "no-width" at "/gripper/width_m": the arm has no such gripper
[[nodiscard]] Result<std::map<std::string, double>> joints_at_width(
    const Cell& cell, const GripperStepRequest& gripper);

// Returns the motion of the gripper from `rest` to this width, while the arm stays. Problems: those
// of joints_at_width(), and of joint_line().
[[nodiscard]] Result<TrajectoryPtr> gripper_motion(const GripperStepRequest& gripper,
                                                   const Cell& cell, const Configuration& rest);

}  // namespace armloom
