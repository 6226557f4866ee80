#include "core/collision/diagram/reach_check.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/collision/diagram/coordination_diagram.h"
#include "core/collision/scene/arm_reach.h"
#include "core/collision/scene/scene_bodies.h"

namespace armloom {
namespace {

struct Times {
  double from_s = 0.0;
  double to_s = std::numeric_limits<double>::infinity();
};

// Returns when the arm may be in this interval of its reach.
Times times_in(const Reach& reach, Duration from, Duration to) {
  const double slack_s = to_seconds(reach.slack);
  Times times;
  const double least_s = to_seconds(from) - slack_s;  // farthest progress must reach this
  if (least_s > 0.0) {
    times.from_s =
        reach.rate_high > 0.0 ? least_s / reach.rate_high : std::numeric_limits<double>::infinity();
  }
  // Beyond the end of its reach, an arm rests there.
  const bool is_end = to >= reach.to - reach.from;
  if (reach.rate_low > 0.0 && !is_end) {
    times.to_s = (to_seconds(to) + slack_s + to_seconds(reach.late)) / reach.rate_low;
  }
  return times;
}

bool at_one_time(const ProgressBox& box, const Reach& a, const Reach& b) {
  const Times in_a = times_in(a, box.from_a, box.to_a);
  const Times in_b = times_in(b, box.from_b, box.to_b);
  const double from_s = std::max(in_a.from_s, in_b.from_s);
  return std::isfinite(from_s) && from_s <= std::min(in_a.to_s, in_b.to_s);
}

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
  return closest(pairs->second, a, &b, tube(b));
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
  return closest(pairs->second, reach, nullptr, still_);
}

// `of_b`: null for static bodies.
std::optional<Proximity> ReachCheck::closest(const PairSet& pairs, const Reach& of_a,
                                             const Reach* of_b, std::shared_ptr<MotionTube> b) {
  if (pairs.empty()) return std::nullopt;
  const PlanningScene::Bodies& bodies = scene_->bodies();
  TubePair tubes({&bodies, &pairs, scratch_}, tube(of_a), std::move(b));
  const auto blocked_in = [&](CoordinationDiagram diagram) {
    evaluations_ += diagram.refine(Duration{}, Duration{}, kResolution, kBudget);
    auto cells = diagram.blocked(Duration{}, Duration{});
    std::erase_if(cells, [&](const auto& cell) {
      return of_b != nullptr && !at_one_time(cell.box, of_a, *of_b);
    });
    return cells;
  };
  std::vector<CoordinationDiagram::Blocked> blocked = blocked_in(CoordinationDiagram(tubes));
  if (blocked.empty()) return std::nullopt;

  // Pairs that are too close now may part.
  auto close = tubes.too_close_at(Duration{}, Duration{});
  for (TubePair::PairDistance& pair : close) pair.distance_m *= kPartingShare;
  PairSet parting;
  if (!close.empty()) {
    parting = pairs;
    let_part(parting, close);
    blocked = blocked_in(CoordinationDiagram(tubes.with({&bodies, &parting, scratch_})));
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
