#include "core/executive/left_touch.h"

#include <algorithm>
#include <set>
#include <utility>

#include "core/collision/check/line_checker.h"
#include "core/trajectory/set_joints.h"

namespace armloom {

void LeftTouch::leave(const std::string& object, const Touch& touch,
                      const std::vector<ArmId>& arms) {
  Left& left = left_[object];
  left.touch.add(touch);
  left.arms.insert(left.arms.end(), arms.begin(), arms.end());
}

std::vector<std::string> LeftTouch::of(const std::vector<ArmId>& arms) const {
  std::vector<std::string> objects;
  for (const auto& [object, left] : left_) {
    const bool is_theirs = std::ranges::find_first_of(left.arms, arms) != left.arms.end();
    if (is_theirs) objects.push_back(object);
  }
  return objects;
}

Touch LeftTouch::allowed(const PlanningScenePtr& scene, const Configuration& at,
                         const std::string& object, Touch now) {
  const auto left = left_.find(object);
  Touch all;
  all.add(now);
  if (left == left_.end()) return all;
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
  std::set<std::string> changed;
  for (const auto& [object, touch] : std::exchange(present, next)) {
    const auto same = next.find(object);
    if (same != next.end() && same->second == touch) continue;
    changed.insert(object);
    left.leave(object, touch, arms);
  }
  for (const auto& [object, touch] : next) changed.insert(object);
  for (const std::string& object : changed) show(object, present, at);
}

void TouchScene::carried_or_placed(const std::string& object, TouchOf& present,
                                   const std::vector<ArmId>& arms, const Configuration& at) {
  TouchOf next = present;
  next[object] = touch_in(*scene, object);
  change(present, next, arms, at);
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
