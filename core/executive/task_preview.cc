#include "core/executive/task_preview.h"

#include <algorithm>
#include <utility>

#include "core/base/add_below.h"
#include "core/executive/holding.h"
#include "core/executive/task_intake.h"
#include "core/trajectory/set_joints.h"

namespace armloom {

Result<PlanningScenePtr> after_action(const PlanningScenePtr& scene, const Configuration& at,
                                      const StepRequest& step) {
  const Cell& cell = scene->cell();
  if (const auto* attach = std::get_if<AttachRequest>(&step.what)) {
    auto content = attached(*scene, at, attach->object, *cell.find_link(attach->link),
                            touch_of(cell, attach->touch));
    if (!content) return failure(std::move(content.error()));
    return scene->with(*std::move(content));
  }
  if (const auto* detach = std::get_if<DetachRequest>(&step.what)) {
    auto content = detached(*scene, at, detach->object);
    if (!content) return failure(std::move(content.error()));
    return scene->with(*std::move(content));
  }
  return scene;
}

std::optional<std::string> object_of(const StepRequest& step) {
  if (const auto* attach = std::get_if<AttachRequest>(&step.what)) return attach->object;
  if (const auto* detach = std::get_if<DetachRequest>(&step.what)) return detach->object;
  return std::nullopt;
}

TaskPreview::TaskPreview(std::vector<PreparedJob::PreparedStep> steps, TouchScene scene,
                         Configuration at)
    : steps_(std::move(steps)), scene_(std::move(scene)), at_(std::move(at)) {
  for (const PreparedJob::PreparedStep& step : steps_) {
    if (!step.motion) continue;
    const auto& moved = step.motion->alternatives.front()->arms();
    arms_.insert(arms_.end(), moved.begin(), moved.end());
  }
}

Result<bool> TaskPreview::go_on() {
  for (; index_ < steps_.size(); ++index_) {
    Problems problems;
    if (steps_[index_].motion) {
      if (auto begun = begin_motion())
        return true;
      else
        add_below(place_of_step(index_), std::move(begun.error()), problems);
    } else if (auto scene = after_action(scene_.scene, at_, steps_[index_].step.request)) {
      scene_.scene = *std::move(scene);
      const auto object = object_of(steps_[index_].step.request);
      if (object) scene_.carried_or_placed(*object, touch_, arms_, at_);
    } else {
      add_below(place_of_step(index_), std::move(scene.error()), problems);
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
