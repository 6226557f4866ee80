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

PlanningScenePtr with_touch(PlanningScenePtr scene, const TouchOf& before, const TouchOf& next) {
  for (const auto& [object, touch] : changed_touch(before, next)) {
    // Names and links are known.
    if (auto changed = scene->with(touching(*scene, object, touch))) scene = *std::move(changed);
  }
  return scene;
}

TaskPreview::TaskPreview(std::vector<PreparedJob::PreparedStep> steps, PlanningScenePtr scene,
                         Configuration at, std::map<std::string, std::vector<ArmId>> left)
    : steps_(std::move(steps)),
      scene_(std::move(scene)),
      at_(std::move(at)),
      left_(std::move(left)) {}

Result<bool> TaskPreview::go_on() {
  for (; index_ < steps_.size(); ++index_) {
    Problems problems;
    if (steps_[index_].motion) {
      if (auto begun = begin_motion())
        return true;
      else
        add_below(place_of_step(index_), std::move(begun.error()), problems);
    } else if (auto scene = after_action(scene_, at_, steps_[index_].step.request)) {
      scene_ = *std::move(scene);
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
    auto motion = gripper_motion(*gripper, scene_->cell(), at_);
    if (!motion) return failure(std::move(motion.error()));
    step.motion->alternatives = {*std::move(motion)};
  }
  scene_ = with_touch(std::move(scene_), touch_, step.step.touch);
  touch_ = step.step.touch;
  return {};
}

void TaskPreview::end_motion(const Trajectory& motion) {
  set_joints(at_, motion, motion.goal());
  std::erase_if(left_, [&](const auto& left) {
    const auto& [object, arms] = left;
    if (std::ranges::find_first_of(arms, motion.arms()) == arms.end()) return false;
    scene_ = with_touch(std::move(scene_), {{object, {}}}, {});
    return true;
  });
  ++index_;
}

}  // namespace armloom
