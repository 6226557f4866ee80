#include "core/collision/diagram/tube_pair.h"

#include <algorithm>
#include <array>
#include <limits>

#include "core/collision/diagram/body_sweep.h"
#include "core/collision/filter/kernels.h"
#include "core/collision/state/body_distance.h"

namespace armloom {
namespace {

using filter::kLanes;
using Block = MotionTube::Block;

}  // namespace

// Nodes of one tube that lie apart, side by side.
struct TubePair::Gathered {
  std::vector<float> capsules, motion_bound, ball, axes, drifts, looses,
      bends;  // MotionTube::Block
};

// What is at hand: nodes to be filtered, what is open of one of them, one state.
struct TubePair::Scratch {
  Gathered a, b;
  struct Hits {
    std::vector<filter::Hit> of;
    int count = 0;
  };
  Hits pairs, boxes;
  std::vector<int> nodes_a, nodes_b;
  filter::Side side_a;
  std::vector<Undecided> undecided;
  std::vector<MovingAxis> axes_a, axes_b;
  struct OneState {
    std::vector<double> frames_a, frames_b, q;
  };
  OneState state;
};

// The nodes of a batch in their tube, lane by lane.
struct TubePair::Batch {
  const MotionTube& tube;
  Gathered& to;
  std::array<MotionTube::Place, kLanes> of{};
  std::size_t count;
  filter::Side side;

  Batch(const MotionTube& tube_of, const std::vector<int>& nodes, Gathered& gathered)
      : tube(tube_of), to(gathered), count(nodes.size()) {
    for (std::size_t lane = 0; lane < count; ++lane) of[lane] = tube.place_of(nodes[lane]);
    side = {rows(&Block::capsules, to.capsules), rows(&Block::motion_bound, to.motion_bound),
            rows(&Block::ball, to.ball)};
  }
  // The block that they are, in its order; null: they are none. That of a rest has it in all lanes.
  [[nodiscard]] const Block* as_block() const {
    if (tube.size() == 1) return of[0].block;
    for (std::size_t lane = 0; lane < count; ++lane) {
      if (of[lane].block != of[0].block || of[lane].lane != lane) return nullptr;
    }
    return of[0].block;
  }
  // Every row of them: the block's own where they are one.
  [[nodiscard]] const float* rows(std::vector<float> Block::*member,
                                  std::vector<float>& gathered) const {
    if (const Block* block = as_block()) return (block->*member).data();
    gathered.resize(std::max(gathered.size(), (of[0].block->*member).size()));
    for (std::size_t lane = 0; lane < count; ++lane) {
      const std::vector<float>& from = of[lane].block->*member;
      for (std::size_t row = 0; row < from.size(); row += kLanes) {
        gathered[row + lane] = from[row + of[lane].lane];
      }
    }
    return gathered.data();
  }
  // Nothing moves what stands still.
  [[nodiscard]] filter::MovedCapsules moved(const filter::ArmKinematics& kinematics) const {
    if (kinematics.frame_count == 0) return {.capsules = side.capsules};
    return {.capsules = side.capsules,
            .kinematics = &kinematics,
            .axes = rows(&Block::axes, to.axes),
            .drift = rows(&Block::drifts, to.drifts),
            .loose = rows(&Block::looses, to.looses),
            .bend = rows(&Block::bends, to.bends)};
  }
};

std::shared_ptr<TubePair::Scratch> TubePair::make_scratch() { return std::make_shared<Scratch>(); }

TubePair::TubePair(Setting setting, std::shared_ptr<MotionTube> a, std::shared_ptr<MotionTube> b)
    : setting_(std::move(setting)), a_(std::move(a)), b_(std::move(b)) {
  Scratch& s = *setting_.scratch;
  const auto make_room = [](auto& of, std::size_t size) { of.resize(std::max(of.size(), size)); };
  make_room(s.pairs.of, setting_.pairs->pairs.size() + 1);
  make_room(s.boxes.of, setting_.pairs->boxes.size() + 1);
  make_room(s.state.frames_a, a_->kinematics().frames().size() * 12);
  make_room(s.state.frames_b, b_->kinematics().frames().size() * 12);
  make_room(s.state.q,
            std::max(a_->kinematics().joints().size(), b_->kinematics().joints().size()));
}

// Of the pairs that bounds of their motion leave open, those that stay so along the direction that
// parts them. Returns their number.
int TubePair::left_open(const Batch& a, const Batch& b, int hits) {
  if (hits == 0) return 0;
  Scratch& s = *setting_.scratch;
  const filter::ArmKinematics kinematics_a = a_->kinematics().view();
  const filter::ArmKinematics kinematics_b = b_->kinematics().view();
  const filter::MovedCapsules of_a = a.moved(kinematics_a);
  const filter::MovedCapsules of_b = b.moved(kinematics_b);
  const filter::Kernel& kernel = filter::best_kernel();
  int left = 0;
  for (int h = 0; h < hits; ++h) {
    filter::Hit& hit = s.pairs.of[static_cast<std::size_t>(h)];
    const filter::Pair& pair = setting_.pairs->pairs[static_cast<std::size_t>(hit.pair)];
    hit.lanes &= ~kernel.keep_apart(of_a, of_b, pair, hit.lanes);
    if (hit.lanes == 0) continue;
    if (left != h) s.pairs.of[static_cast<std::size_t>(left)] = hit;
    ++left;
  }
  return left;
}

void TubePair::filter(std::span<const Nodes> batch) {
  Scratch& s = *setting_.scratch;
  s.nodes_a.clear();
  s.nodes_b.clear();
  for (const Nodes& nodes : batch) {
    s.nodes_a.push_back(nodes.a);
    s.nodes_b.push_back(nodes.b);
  }
  a_->place(s.nodes_a);
  if (is_self()) return;  // its tube has filtered them
  b_->place(s.nodes_b);
  const Batch a(*a_, s.nodes_a, s.a);
  const Batch b(*b_, s.nodes_b, s.b);
  s.side_a = a.side;
  const PairSet& set = *setting_.pairs;
  const filter::Kernel& kernel = filter::best_kernel();
  const unsigned lanes = (1U << batch.size()) - 1U;
  const int found = kernel.near_pairs(a.side, b.side, set.grouped(), lanes, s.pairs.of.data());
  s.pairs.count = left_open(a, b, found);
  s.boxes.count = kernel.near_boxes(a.side, set.boxes.data(), static_cast<int>(set.boxes.size()),
                                    lanes, s.boxes.of.data());
}

std::vector<TubePair::Undecided>& TubePair::undecided(std::size_t lane) {
  Scratch& s = *setting_.scratch;
  const PairSet& set = *setting_.pairs;
  s.undecided.clear();
  const auto add = [&](int entry, bool box, double distance_m, double moves_a_m, double moves_m) {
    const NarrowPair& pair = narrow(entry, box);
    const BodyPair& bodies = setting_.bodies->pairs[pair.pair.index()];
    const double slack_m = setting_.bodies->bodies[bodies.a].fitted.overestimate_m +
                           setting_.bodies->bodies[bodies.b].fitted.overestimate_m;
    s.undecided.push_back(
        {entry, box, distance_m, moves_a_m, moves_m - moves_a_m, pair.limit_m, slack_m});
  };
  if (is_self()) {
    for (const MotionTube::SelfHit& hit : a_->self_hits(s.nodes_a[lane])) {
      add(hit.pair, false, hit.distance, hit.motion_bound, hit.motion_bound);
    }
    return s.undecided;
  }
  const auto add_all = [&](const std::vector<filter::Hit>& hits, int count, bool box) {
    for (const filter::Hit& hit : std::span(hits).first(static_cast<std::size_t>(count))) {
      if ((hit.lanes >> lane & 1U) == 0) continue;
      const auto entry = static_cast<std::size_t>(hit.pair);
      const auto row =
          static_cast<std::size_t>(box ? set.boxes[entry].row_a : set.pairs[entry].row_a);
      add(hit.pair, box, hit.distance[lane], s.side_a.motion_bound[row * kLanes + lane],
          hit.motion_bound[lane]);
    }
  };
  add_all(s.pairs.of, s.pairs.count, false);
  add_all(s.boxes.of, s.boxes.count, true);
  return s.undecided;
}

const NarrowPair& TubePair::narrow(int entry, bool box) const {
  const auto i = static_cast<std::size_t>(entry);
  return box ? setting_.pairs->narrow_boxes[i] : setting_.pairs->narrow[i];
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

double TubePair::distance(const NarrowPair& pair, Nodes at, double limit_m) const {
  return body_distance(setting_.bodies->shapes, placed_a(pair, at), placed_b(pair, at), limit_m);
}

std::size_t TubePair::limits_kept(const NarrowPair& pair, Nodes at,
                                  std::span<const double> limits_m) const {
  return armloom::limits_kept(setting_.bodies->shapes, placed_a(pair, at), placed_b(pair, at),
                              limits_m);
}

bool TubePair::keeps_apart(const NarrowPair& pair, Nodes at, double limit_m, double enough_m) {
  const KinematicBody& a = body_a(pair);
  const KinematicBody& b = body_b(pair);
  std::size_t common = 0;  // what moves both does not part them
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
  for (const auto* pairs : {&setting_.pairs->narrow, &setting_.pairs->narrow_boxes}) {
    for (std::size_t i = 0; i < pairs->size(); ++i) {
      const NarrowPair& pair = (*pairs)[i];
      if (i > 0 && pair.pair == (*pairs)[i - 1].pair) continue;  // another capsule of the same
      const double distance_m = placed_distance(pair, pair.limit_m);
      if (distance_m < pair.limit_m) close.push_back({pair.pair, distance_m});
    }
  }
  return close;
}

TubePair::PairDistance TubePair::closest_at(Duration time_a, Duration time_b) {
  place(time_a, time_b);
  PairDistance closest{PairId{0}, std::numeric_limits<double>::infinity()};
  for (const auto* pairs : {&setting_.pairs->narrow, &setting_.pairs->narrow_boxes}) {
    for (const NarrowPair& pair : *pairs) {
      const double distance_m = placed_distance(pair, closest.distance_m);
      if (distance_m < closest.distance_m) closest = {pair.pair, distance_m};
    }
  }
  return closest;
}

}  // namespace armloom
