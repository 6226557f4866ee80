#include "core/executive/task_preview.h"

#include <algorithm>
#include <utility>

#include "core/base/add_below.h"
#include "core/executive/gripper_goal.h"
#include "core/executive/holding.h"
#include "core/executive/task_intake.h"
#include "core/trajectory/set_joints.h"

namespace armloom {

TaskPreview::TaskPreview(std::vector<PreparedJob::PreparedStep> steps, TouchScene scene,
                         Configuration at)
    : steps_(std::move(steps)),
      scene_(std::move(scene)),
      at_(std::move(at)),
      arms_(arms_of(steps_)) {}

Result<bool> TaskPreview::go_on() {
  for (; index_ < steps_.size(); ++index_) {
    Problems problems;
    if (steps_[index_].motion) {
      if (auto begun = begin_motion())
        return true;
      else
        add_below(place_of_step(index_), std::move(begun.error()), problems);
    } else if (auto done = scene_.act(steps_[index_].step.request, touch_, arms_, at_); !done) {
      add_below(place_of_step(index_), std::move(done.error()), problems);
    }
    if (!problems.empty()) return failure(std::move(problems));
  }
  return false;
}

// The motion of a gripper begins where its arm then is.
Result<void> TaskPreview::begin_motion() {
  PreparedJob::PreparedStep& step = steps_[index_];
  if (const auto* gripper = std::get_if<GripperStepRequest>(&step.step.request.what)) {
    auto motion = gripper_motion(*gripper, scene()->cell(), at_);
    if (!motion) return failure(std::move(motion.error()));
    step.motion->alternatives = {*std::move(motion)};
  }
  scene_.change(touch_, step.step.touch, arms_, at_);
  return {};
}

void TaskPreview::end_motion(const Trajectory& motion) {
  set_joints(at_, motion, motion.goal());
  scene_.moved(motion.arms(), touch_, at_);
  ++index_;
}

TouchScene TaskPreview::scene_after() {
  scene_.change(touch_, {}, arms_, at_);
  return scene_;
}

}  // namespace armloom
