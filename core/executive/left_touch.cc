#include "core/executive/left_touch.h"

#include <algorithm>
#include <utility>

#include "core/collision/check/line_checker.h"
#include "core/trajectory/set_joints.h"

namespace armloom {

namespace {

// Returns the content after an `attach` or `detach`.
Result<PlanningScene::Content> after(const PlanningScene& scene, const Configuration& at,
                                     const StepRequest& step) {
  const Cell& cell = scene.cell();
  if (const auto* attach = std::get_if<AttachRequest>(&step.what)) {
    return attached(scene, at, attach->object, *cell.find_link(attach->link),
                    touch_of(cell, attach->touch), attach->shared);
  }
  const auto& detach = std::get<DetachRequest>(step.what);
  return detached(scene, at, detach.object, cell.find_link(detach.link));
}

}  // namespace

std::set<std::string> LeftTouch::change(TouchOf& present, const TouchOf& next,
                                        const std::vector<ArmId>& arms) {
  std::set<std::string> changed;
  for (const auto& [object, touch] : std::exchange(present, next)) {
    const auto same = next.find(object);
    if (same != next.end() && same->second == touch) continue;
    changed.insert(object);
    Left& left = left_[object];
    left.touch.add(touch);
    left.arms.insert(arms.begin(), arms.end());
  }
  for (const auto& [object, touch] : next) changed.insert(object);
  return changed;
}

std::vector<std::string> LeftTouch::of(const std::vector<ArmId>& arms) const {
  std::vector<std::string> objects;
  for (const auto& [object, left] : left_) {
    const auto is_left = [&of = left.arms](ArmId arm) { return of.contains(arm); };
    if (std::ranges::any_of(arms, is_left)) objects.push_back(object);
  }
  return objects;
}

Touch LeftTouch::allowed(const PlanningScenePtr& scene, const Configuration& at,
                         const std::string& object, Touch now) {
  const auto left = left_.find(object);
  Touch all;
  all.add(now);
  if (left == left_.end()) return all;
  const auto carrier = carrier_of(*scene, object);
  // Another arm has taken it.
  if (carrier && !left->second.arms.contains(*scene->cell().link(*carrier).arm)) return all;
  const Cell& cell = scene->cell();
  const auto without = scene->with(touching(*scene, object, std::move(now)));
  const auto can_move = [&](ArmId arm) {
    return LineChecker(*without, arm, at, TrackingErrors(cell))
               .state(joints_of(at, cell.arm(arm).joints))
               .kind == LineChecker::Kind::free;
  };
  if (!without || std::ranges::all_of(left->second.arms, can_move)) {
    left_.erase(left);
  } else {
    all.add(left->second.touch);
  }
  return all;
}

void TouchScene::change(TouchOf& present, const TouchOf& next, const std::vector<ArmId>& arms,
                        const Configuration& at) {
  for (const std::string& object : left.change(present, next, arms)) show(object, present, at);
}

Result<void> TouchScene::act(const StepRequest& step, TouchOf& present,
                             const std::vector<ArmId>& arms, const Configuration& at) {
  const auto* attach = std::get_if<AttachRequest>(&step.what);
  const auto* detach = std::get_if<DetachRequest>(&step.what);
  if (attach == nullptr && detach == nullptr) return {};
  auto content = after(*scene, at, step);
  if (!content) return failure(std::move(content.error()));
  auto made = scene->with(*std::move(content));
  if (!made) return failure(std::move(made.error()));
  scene = *std::move(made);
  const std::string& object = attach != nullptr ? attach->object : detach->object;
  TouchOf next = present;
  next[object] = touch_in(*scene, object);
  change(present, next, arms, at);
  return {};
}

void TouchScene::moved(const std::vector<ArmId>& arms, const TouchOf& present,
                       const Configuration& at) {
  for (const std::string& object : left.of(arms)) show(object, present, at);
}

void TouchScene::show(const std::string& object, const TouchOf& present, const Configuration& at) {
  const auto now = present.find(object);
  Touch touch = left.allowed(scene, at, object, now == present.end() ? Touch{} : now->second);
  if (touch_in(*scene, object) == touch) return;
  // Names and links are known.
  if (auto made = scene->with(touching(*scene, object, std::move(touch)))) scene = *std::move(made);
}

}  // namespace armloom
