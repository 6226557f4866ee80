#pragma once

#include <cstddef>
#include <vector>

#include "core/base/problem.h"
#include "core/collision/scene/planning_scene.h"
#include "core/executive/job_intake.h"
#include "core/executive/left_touch.h"
#include "core/executive/task.h"

namespace armloom {

// Goes through the steps of a task without executing them. Inputs are assumed to have the values
// that the steps wait for.
//
//   while (go_on() returns true) { find the motion of index() in scene() from at(); end_motion(); }
class TaskPreview {
 public:
  // `at`: positions of all joints before the first step (rad, m)
  TaskPreview(std::vector<PreparedJob::PreparedStep> steps, TouchScene scene, Configuration at);

  // Does the actions before the next motion. Returns false if there is no further motion. Problems,
  // with pointers "/steps/2/attach/object": those of TouchScene::act() and of gripper_motion();
  // index() is then the step that cannot be done.
  [[nodiscard]] Result<bool> go_on();
  // The present motion has been found, and ends at its goal.
  void end_motion(const Trajectory& motion);

  [[nodiscard]] std::size_t index() const { return index_; }  // of the present step
  [[nodiscard]] const std::vector<PreparedJob::PreparedStep>& steps() const { return steps_; }
  // Returns the present motion. Precondition: go_on() has returned true.
  [[nodiscard]] const PreparedMotion& motion() const { return *steps_[index_].motion; }
  // The scene and the positions of all joints when the present motion begins.
  [[nodiscard]] const PlanningScenePtr& scene() const { return scene_.scene; }
  [[nodiscard]] const Configuration& at() const { return at_; }
  // Returns what objects may touch in scene(), besides what the scene before the task allows.
  [[nodiscard]] const TouchOf& touch() const { return touch_; }
  // Returns the scene after the task. Precondition: go_on() has returned false or a problem.
  [[nodiscard]] TouchScene scene_after();

 private:
  [[nodiscard]] Result<void> begin_motion();

  std::vector<PreparedJob::PreparedStep> steps_;
  std::size_t index_ = 0;
  TouchScene scene_;
  Configuration at_;
  TouchOf touch_ = {};
  std::vector<ArmId> arms_ = {};  // of the task
};

}  // namespace armloom
