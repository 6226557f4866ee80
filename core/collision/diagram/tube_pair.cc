#include "core/collision/diagram/tube_pair.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>

#include "core/collision/diagram/body_sweep.h"
#include "core/collision/diagram/tube_scratch.h"
#include "core/collision/state/body_distance.h"

namespace armloom {
namespace {

using filter::kLanes;

}  // namespace

bool TubePair::goes_on(std::uint64_t cells) const {
  CheckProgress* progress = setting_.scratch->progress;
  if (progress == nullptr) return true;
  progress->add(cells);
  return !progress->is_interrupted();
}

std::shared_ptr<TubePair::Scratch> TubePair::make_scratch() { return std::make_shared<Scratch>(); }

TubePair::TubePair(Setting setting, std::shared_ptr<MotionTube> a, std::shared_ptr<MotionTube> b)
    : setting_(std::move(setting)), a_(std::move(a)), b_(std::move(b)) {
  Scratch& s = *setting_.scratch;
  const auto make_room = [](auto& of, std::size_t size) { of.resize(std::max(of.size(), size)); };
  make_room(s.pairs.of, setting_.pairs->pairs.size() + 1);
  make_room(s.parted, setting_.pairs->pairs.size() + 1);
  make_room(s.boxes.of, setting_.pairs->box_hits_max() + 1);
  make_room(s.state.frames_a, a_->kinematics().frames().size() * 12);
  make_room(s.state.frames_b, b_->kinematics().frames().size() * 12);
  make_room(s.state.q,
            std::max(a_->kinematics().joints().size(), b_->kinematics().joints().size()));
}

NarrowPair TubePair::narrow(int entry, bool box) const {
  if (!box) return setting_.pairs->narrow[static_cast<std::size_t>(entry)];
  const auto capsules = static_cast<int>(setting_.pairs->boxed.size());
  return setting_.pairs->narrow_of(entry / capsules, entry % capsules);
}

const KinematicBody& TubePair::body_a(const NarrowPair& pair) const {
  return a_->kinematics().bodies()[static_cast<std::size_t>(pair.body_a)];
}
const KinematicBody& TubePair::body_b(const NarrowPair& pair) const {
  return b_->kinematics().bodies()[static_cast<std::size_t>(pair.body_b)];
}

PlacedBody TubePair::placed_a(const NarrowPair& pair, Nodes at) const {
  const KinematicBody& a = body_a(pair);
  return {setting_.bodies->bodies[a.body], body_pose(a, a_->place_of(at.a).frames(), kLanes)};
}
PlacedBody TubePair::placed_b(const NarrowPair& pair, Nodes at) const {
  const KinematicBody& b = body_b(pair);
  return {setting_.bodies->bodies[b.body], body_pose(b, b_->place_of(at.b).frames(), kLanes)};
}

double TubePair::distance(const NarrowPair& pair, Nodes at, double limit_m,
                          const Roughness& of_surfaces) const {
  return body_distance(setting_.bodies->shapes, placed_a(pair, at), placed_b(pair, at), limit_m,
                       of_surfaces);
}

std::size_t TubePair::limits_kept(const NarrowPair& pair, Nodes at,
                                  std::span<const double> limits_m) const {
  return armloom::limits_kept(setting_.bodies->shapes, placed_a(pair, at), placed_b(pair, at),
                              limits_m);
}

bool TubePair::keeps_apart(const NarrowPair& pair, Nodes at, double limit_m, double enough_m) {
  const KinematicBody& a = body_a(pair);
  const KinematicBody& b = body_b(pair);
  std::size_t common = 0;  // joints upstream of both bodies do not change their distance
  if (is_self()) {
    const auto of_a = a_->kinematics().ancestors(a.frame);
    const auto of_b = a_->kinematics().ancestors(b.frame);
    common = static_cast<std::size_t>(std::ranges::mismatch(of_a, of_b).in1 - of_a.begin());
  }
  Scratch& s = *setting_.scratch;
  a_->axes_of(at.a, a.frame, common, s.axes_a);
  b_->axes_of(at.b, b.frame, common, s.axes_b);
  return keep_apart(setting_.bodies->shapes, {placed_a(pair, at), s.axes_a},
                    {placed_b(pair, at), s.axes_b}, limit_m, enough_m);
}

void TubePair::place(Duration time_a, Duration time_b) {
  Scratch& s = *setting_.scratch;
  a_->configuration(time_a, s.state.q.data());
  place_frames(a_->kinematics(), s.state.q.data(), s.state.frames_a.data());
  b_->configuration(is_self() ? time_a : time_b, s.state.q.data());
  place_frames(b_->kinematics(), s.state.q.data(), s.state.frames_b.data());
}

double TubePair::placed_distance(const NarrowPair& pair, double limit_m) const {
  const KinematicBody& a = body_a(pair);
  const KinematicBody& b = body_b(pair);
  const Scratch& s = *setting_.scratch;
  const std::vector<CollisionBody>& bodies = setting_.bodies->bodies;
  return body_distance(setting_.bodies->shapes,
                       {bodies[a.body], body_pose(a, s.state.frames_a.data())},
                       {bodies[b.body], body_pose(b, s.state.frames_b.data())}, limit_m);
}

std::vector<TubePair::PairDistance> TubePair::too_close_at(Duration time_a, Duration time_b) {
  place(time_a, time_b);
  std::vector<PairDistance> close;
  std::optional<PairId> last;
  const auto look = [&](const NarrowPair& pair) {
    if (std::exchange(last, pair.pair) == pair.pair) return;  // another capsule of this pair
    const double distance_m = placed_distance(pair, pair.limit_m);
    if (distance_m < pair.limit_m) close.push_back({pair.pair, distance_m});
  };
  std::ranges::for_each(setting_.pairs->narrow, look);
  setting_.pairs->each_boxed(look);
  return close;
}

double TubePair::proven_distance(const NarrowPair& pair, Nodes at, double distance_m,
                                 double moves_m) {
  constexpr int kHalvings = 6;
  double proven_m = std::max(distance_m - moves_m, 0.0);
  double open_m = distance_m;
  for (int i = 0; i < kHalvings && distance_m > 0.0; ++i) {
    const double limit_m = 0.5 * (proven_m + open_m);
    (keeps_apart(pair, at, limit_m, limit_m + moves_m) ? proven_m : open_m) = limit_m;
  }
  return proven_m;
}

std::vector<TubePair::PairDistance> TubePair::near_at(Duration time_a, Duration time_b) {
  const auto a = a_->still_at(time_a);
  TubePair still(setting_, a, is_self() ? a : b_->still_at(time_b));
  const Nodes nodes{TimeTree::root(), TimeTree::root()};
  still.filter({&nodes, 1});
  std::vector<PairDistance> near;
  for (const Undecided& u : still.undecided(0)) {
    const NarrowPair& pair = still.narrow(u.narrow, u.box);
    const double enough_m = u.limit_m + u.moves_m();
    const double distance_m = still.distance(pair, nodes, enough_m);
    if (distance_m >= enough_m) continue;
    const double deviates_m =
        distance_m - still.proven_distance(pair, nodes, distance_m, u.moves_m());
    const double worst_m = std::max(std::min(distance_m, u.limit_m) - deviates_m, 0.0);
    const double least_m = std::max(worst_m - kPartingLoss_m, kPartingShare * worst_m);
    const auto known = std::ranges::find(near, pair.pair, &PairDistance::pair);
    if (known == near.end()) {
      near.push_back({pair.pair, least_m});
    } else {  // another capsule of this pair
      known->distance_m = std::min(known->distance_m, least_m);
    }
  }
  return near;
}

void let_part(PairSet& pairs, std::span<const TubePair::PairDistance> near) {
  pairs.set_each_limit([&](const NarrowPair& pair) {
    const auto found = std::ranges::find(near, pair.pair, &TubePair::PairDistance::pair);
    if (found == near.end()) return pair.limit_m;
    return std::min(pair.limit_m, std::max(found->distance_m, kTouching_m));
  });
}

TubePair::PairDistance TubePair::closest_at(Duration time_a, Duration time_b) {
  place(time_a, time_b);
  PairDistance closest{PairId{0}, std::numeric_limits<double>::infinity()};
  const auto look = [&](const NarrowPair& pair) {
    const double distance_m = placed_distance(pair, closest.distance_m);
    if (distance_m < closest.distance_m) closest = {pair.pair, distance_m};
  };
  std::ranges::for_each(setting_.pairs->narrow, look);
  setting_.pairs->each_boxed(look);
  return closest;
}

}  // namespace armloom
