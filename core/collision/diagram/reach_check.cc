#include "core/collision/diagram/reach_check.h"

#include <algorithm>

#include "core/collision/diagram/coordination_diagram.h"
#include "core/collision/scene/arm_reach.h"
#include "core/collision/scene/scene_bodies.h"

namespace armloom {
namespace {

constexpr double kPartingShare = 0.8;  // as in OrientedDiagram

}  // namespace

ReachCheck::ReachCheck(PlanningScenePtr scene, double clearance_m)
    : scene_(std::move(scene)),
      limits_(PairLimits::scaled(scene_->cell(), clearance_m)),
      scratch_(TubePair::make_scratch()) {
  for (std::uint32_t a = 0; a < scene_->cell().arms.size(); ++a) {
    auto geometry = std::make_shared<ArmGeometry>(scene_->bodies(), ArmId{a});
    geometry->self = {};  // an arm is not compared with itself
    tube_scratch_.push_back(MotionTube::make_scratch(*geometry));
    geometry_.push_back(std::move(geometry));
  }
}

std::shared_ptr<MotionTube> ReachCheck::tube(const Reach& reach) {
  const std::size_t arm = reach.arm.index();
  return std::make_shared<MotionTube>(geometry_[arm], reach, tube_scratch_[arm]);
}

std::optional<Proximity> ReachCheck::may_meet(const Reach& a, const Reach& b) {
  if (b.arm < a.arm) return may_meet(b, a);
  const std::vector<Ball>& balls = scene_->bodies().reach;
  if (out_of_reach(balls[a.arm.index()], balls[b.arm.index()], limits_.clearance_m)) {
    return std::nullopt;
  }
  const auto [pairs, is_new] = pairs_.try_emplace({a.arm, b.arm});
  if (is_new) {
    pairs->second = pairs_between(scene_->bodies(), geometry_[a.arm.index()]->kinematics,
                                  geometry_[b.arm.index()]->kinematics);
    pairs->second.set_limits(limits_);
  }
  return closest(pairs->second, tube(a), tube(b));
}

std::optional<Proximity> ReachCheck::may_meet_scene(const Reach& reach) {
  if (still_ == nullptr) {
    still_ = std::make_shared<MotionTube>(
        std::make_shared<const ArmGeometry>(scene_->bodies(), std::nullopt), nullptr,
        scene_->cell().home(), 0.0);
  }
  const auto [pairs, is_new] = pairs_.try_emplace({reach.arm, std::nullopt});
  if (is_new) {
    pairs->second = pairs_between(scene_->bodies(), geometry_[reach.arm.index()]->kinematics,
                                  still_->kinematics());
    pairs->second.set_limits(limits_);
  }
  return closest(pairs->second, tube(reach), still_);
}

std::optional<Proximity> ReachCheck::closest(const PairSet& pairs, std::shared_ptr<MotionTube> a,
                                             std::shared_ptr<MotionTube> b) {
  if (pairs.empty()) return std::nullopt;
  const PlanningScene::Bodies& bodies = scene_->bodies();
  TubePair tubes({&bodies, &pairs, scratch_}, std::move(a), std::move(b));
  CoordinationDiagram diagram(tubes);
  evaluations_ += diagram.refine(Duration{}, Duration{}, kResolution, kBudget);
  std::vector<CoordinationDiagram::Blocked> blocked = diagram.blocked(Duration{}, Duration{});
  if (blocked.empty()) return std::nullopt;

  // Pairs that are too close now may part.
  const auto close = tubes.too_close_at(Duration{}, Duration{});
  PairSet parting;
  if (!close.empty()) {
    parting = pairs;
    parting.set_each_limit([&](const NarrowPair& pair) {
      const auto found = std::ranges::find(close, pair.pair, &TubePair::PairDistance::pair);
      return found == close.end() ? pair.limit_m
                                  : std::max(kPartingShare * found->distance_m, kTouching_m);
    });
    CoordinationDiagram apart(tubes.with({&bodies, &parting, scratch_}));
    evaluations_ += apart.refine(Duration{}, Duration{}, kResolution, kBudget);
    blocked = apart.blocked(Duration{}, Duration{});
    if (blocked.empty()) return std::nullopt;
  }

  std::optional<CoordinationDiagram::Witness> found;
  for (const CoordinationDiagram::Blocked& cell : blocked) {
    if (cell.found && (!found || cell.found->distance_m < found->distance_m)) found = cell.found;
  }
  if (!found) {
    const auto now = tubes.closest_at(Duration{}, Duration{});
    found = {now.pair, now.distance_m, {}, {}, 0.0};
  }
  const BodyPair& pair = bodies.pairs[found->pair.index()];
  Proximity proximity =
      proximity_of(bodies.bodies[pair.a], bodies.bodies[pair.b], found->distance_m);
  proximity.limit_m = bodies.group_of(found->pair).limit_m(limits_);
  return proximity;
}

}  // namespace armloom
