#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "core/executive/task_request.h"
#include "core/model/cell.h"

namespace armloom {

// Returns the JSON pointer "/steps/2".
[[nodiscard]] std::string place_of_step(std::size_t i);

// The objects of the cell when a task is submitted.
struct PresentObjects {
  std::vector<std::string> names;
  // By name: the link that carries the object after all tasks before this one.
  std::map<std::string, LinkId> carried;
  std::map<std::string, double> masses_kg = {};  // by name, if not zero
};

// Returns the objects of the scene, and what is carried now.
[[nodiscard]] PresentObjects present_objects(const PlanningScene& scene);

// Adds what is wrong with the actions of a task, with pointers "/steps/2/attach/link":
// - "unknown-object", "unknown-link", "link-not-of-arm", "unknown-io", "wrong-type"
// - "not-held": an object is detached that no arm holds at that step
// - "held-twice": an object is attached to a hand that holds it already
// - "no-motion-after": the arm of an attach or detach has no motion after it in the task
// - "ends-with-wait": the last step waits
// - "no-motion": no step moves an arm
void find_bad_steps(const Cell& cell, const std::vector<StepRequest>& steps,
                    const PresentObjects& present, Problems& problems);

// Returns why these steps, which have been found good before, do not fit what the arms hold now;
// nullopt if they do.
[[nodiscard]] std::optional<std::string> find_misfit(const Cell& cell,
                                                     const std::vector<StepRequest>& steps,
                                                     const PresentObjects& present);

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
