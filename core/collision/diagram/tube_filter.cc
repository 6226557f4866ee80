// Filters a batch of cells of a TubePair: finds the pairs of capsules that stay undecided in each
// cell.
#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include "core/collision/diagram/tube_pair.h"
#include "core/collision/diagram/tube_scratch.h"
#include "core/collision/filter/kernels.h"

namespace armloom {
namespace {

using filter::kLanes;
using Block = MotionTube::Block;

}  // namespace

struct TubePair::Batch {
  const MotionTube& tube;
  Gathered& to;
  std::array<MotionTube::Place, kLanes> of{};
  std::size_t count;
  filter::Side side;

  Batch(const MotionTube& tube_of, const std::vector<int>& nodes, Gathered& gathered)
      : tube(tube_of), to(gathered), count(nodes.size()) {
    for (std::size_t lane = 0; lane < count; ++lane) of[lane] = tube.place_of(nodes[lane]);
    const std::size_t capsules = tube.kinematics().capsules().size();
    if (const Block* block = as_block()) {
      side = {block->capsules,
              block->motion_bound,
              block->ball,
              {block->spread, filter::spread_size(static_cast<int>(capsules))},
              block->sweeps};
      return;
    }
    side = {gather(&Block::capsules, 6 * capsules, to.capsules),
            gather(&Block::motion_bound, capsules, to.motion_bound),
            gather(&Block::ball, 4, to.ball)};
  }
  // If lane i of the batch is lane i of one block of the tube, returns that block, else null. A
  // tube with a single node (an arm at rest) has this node in every lane of its block.
  [[nodiscard]] const Block* as_block() const {
    if (tube.size() == 1) return of[0].block;
    for (std::size_t lane = 0; lane < count; ++lane) {
      if (of[lane].block != of[0].block || of[lane].lane != lane) return nullptr;
    }
    return of[0].block;
  }
  // Copies the rows of a Block member, with the nodes of the batch lane by lane.
  [[nodiscard]] const float* gather(float* Block::*member, std::size_t rows,
                                    std::vector<float>& gathered) const {
    gathered.resize(std::max(gathered.size(), rows * kLanes));
    for (std::size_t lane = 0; lane < count; ++lane) {
      const float* from = of[lane].block->*member + of[lane].lane;
      for (std::size_t row = 0; row < rows; ++row)
        gathered[row * kLanes + lane] = from[row * kLanes];
    }
    return gathered.data();
  }
};

struct TubePair::Lanes {
  struct Side {
    MotionTube::Place at;
    MotionTube::Stretches stretches;

    [[nodiscard]] filter::SweptCapsule swept(int capsule) const {
      const auto row = [capsule](const float* of, int rows) {
        return of + static_cast<std::ptrdiff_t>(capsule) * rows * kLanes;
      };
      return {row(at.block->capsules, 6) + at.lane, row(stretches.block->capsules, 6),
              row(stretches.block->sweeps, filter::kSweep), stretches.first, stretches.end};
    }
  };
  std::array<Side, kLanes> a, b;
  unsigned lost = 0;  // bit by lane: a pair cannot be proven apart, so no others are tried
};

// Bounds the distance of a hit's capsules along the direction that separates them, for all
// combinations of stretches. Marks the lane as lost if not even the exact shapes can be proven
// apart.
void TubePair::look_along(Lanes& lanes, const filter::Hit& hit, unsigned lane,
                          filter::Parted& parted) const {
  const filter::Pair& pair = setting_.pairs->pairs[static_cast<std::size_t>(hit.pair)];
  const Lanes::Side& a = lanes.a[lane];
  const Lanes::Side& b = lanes.b[lane];
  parted = a.stretches.block == nullptr || b.stretches.block == nullptr
               ? filter::Parted{hit.distance[lane] - hit.motion_bound[lane], {0.0F, 0.0F}}
               : filter::best_kernel().parted(a.swept(pair.a), b.swept(pair.b), pair,
                                              hit.direction + lane);
  const double short_m = static_cast<double>(pair.limit_up - parted.distance);
  if (short_m > kAlongShapes_m && short_m > slack_m(narrow(hit.pair, false)) + kAlongShapes_m) {
    lanes.lost |= 1U << lane;
  }
}

// Keeps the hits that are not proven apart along the direction that separates their capsules;
// returns their number. Tries the closest pair of each cell first.
int TubePair::left_open(int hits) {
  Scratch& s = *setting_.scratch;
  const auto limit_m = [this](const filter::Hit& hit) {
    return setting_.pairs->pairs[static_cast<std::size_t>(hit.pair)].limit_up;
  };
  Lanes lanes;
  std::array<int, kLanes> closest;
  std::array<float, kLanes> least_m;
  closest.fill(-1);
  least_m.fill(std::numeric_limits<float>::infinity());
  for (int h = 0; h < hits; ++h) {
    const filter::Hit& hit = s.pairs.of[static_cast<std::size_t>(h)];
    for (unsigned lane = 0; lane < kLanes; ++lane) {
      const float room_m = hit.distance[lane] - hit.motion_bound[lane] - limit_m(hit);
      if ((hit.lanes >> lane & 1U) == 0 || room_m >= least_m[lane]) continue;
      least_m[lane] = room_m;
      closest[lane] = h;
    }
  }
  const auto side = [&s](MotionTube& tube, int node) -> Lanes::Side {
    const MotionTube::Place at = tube.place_of(node);
    if (s.in_stretches) return {at, tube.stretches_of(node)};
    const auto only = static_cast<int>(at.lane);
    return {at, {at.block, only, only + 1}};
  };
  for (unsigned lane = 0; lane < kLanes; ++lane) {
    if (closest[lane] < 0) continue;
    lanes.a[lane] = side(*a_, s.nodes_a[lane]);
    lanes.b[lane] = side(*b_, s.nodes_b[lane]);
    look_along(lanes, s.pairs.of[static_cast<std::size_t>(closest[lane])], lane,
               s.parted_closest[lane]);
  }
  int left = 0;
  for (int h = 0; h < hits; ++h) {
    filter::Hit& hit = s.pairs.of[static_cast<std::size_t>(h)];
    filter::Parted* parted = s.parted[static_cast<std::size_t>(left)].of;
    for (unsigned open = hit.lanes; open != 0; open &= open - 1) {
      const auto lane = static_cast<unsigned>(std::countr_zero(open));
      if (closest[lane] == h) {
        parted[lane] = s.parted_closest[lane];
      } else if ((lanes.lost >> lane & 1U) != 0) {
        parted[lane] = {limit_m(hit), {0.0F, 0.0F}};
        continue;
      } else {
        look_along(lanes, hit, lane, parted[lane]);
      }
      if (parted[lane].distance >= limit_m(hit)) hit.lanes &= ~(1U << lane);
    }
    if (hit.lanes == 0) continue;
    if (left != h) s.pairs.of[static_cast<std::size_t>(left)] = hit;
    ++left;
  }
  return left;
}

void TubePair::place_all(std::span<const Nodes> nodes) {
  Scratch& s = *setting_.scratch;
  s.nodes_a.clear();
  s.nodes_b.clear();
  for (const Nodes& at : nodes) {
    s.nodes_a.push_back(at.a);
    s.nodes_b.push_back(at.b);
  }
  a_->place(s.nodes_a, is_self());
  if (!is_self()) b_->place(s.nodes_b);
}

// Returns the placed nodes, as bits, in which the balls around both arms may be too close. Most
// cells of long motions are decided so, before their capsules are gathered.
unsigned TubePair::near_lanes() const {
  const Scratch& s = *setting_.scratch;
  unsigned near = 0;
  for (std::size_t lane = 0; lane < s.nodes_a.size(); ++lane) {
    const MotionTube::Place a = a_->place_of(s.nodes_a[lane]), b = b_->place_of(s.nodes_b[lane]);
    float squared = 0.0F;
    for (std::size_t k = 0; k < 3; ++k) {
      const float w = a.block->ball[k * kLanes + a.lane] - b.block->ball[k * kLanes + b.lane];
      squared += w * w;
    }
    const float reach = (a.block->ball[3 * kLanes + a.lane] + b.block->ball[3 * kLanes + b.lane] +
                         setting_.pairs->limit_up) *
                        1.00001F;
    near |= squared >= reach * reach ? 0U : 1U << lane;
  }
  return near;
}

void TubePair::filter(std::span<const Nodes> batch, bool in_stretches) {
  Scratch& s = *setting_.scratch;
  s.in_stretches = in_stretches;
  place_all(batch);
  if (is_self()) return;  // the tube has filtered its own pairs
  const PairSet& set = *setting_.pairs;
  s.pairs.count = s.boxes.count = 0;
  const unsigned lanes = b_->kinematics().arm() ? near_lanes() : (1U << batch.size()) - 1U;
  if (lanes == 0) return;
  const Batch a(*a_, s.nodes_a, s.a);
  const Batch b(*b_, s.nodes_b, s.b);
  s.side_a = a.side;
  const filter::Kernel& kernel = filter::best_kernel();
  const int found = kernel.near_pairs(a.side, b.side, set.grouped(), lanes, s.pairs.of.data());
  s.pairs.count = left_open(found);
  s.boxes.count = kernel.near_boxes(a.side, set.all_boxes(), lanes, s.boxes.of.data());
}

double TubePair::slack_m(const NarrowPair& pair) const {
  const BodyPair& bodies = setting_.bodies->pairs[pair.pair.index()];
  return setting_.bodies->bodies[bodies.a].fitted.overestimate_m +
         setting_.bodies->bodies[bodies.b].fitted.overestimate_m;
}

std::vector<TubePair::Undecided>& TubePair::undecided(std::size_t lane) {
  Scratch& s = *setting_.scratch;
  const PairSet& set = *setting_.pairs;
  s.undecided.clear();
  // Estimate for pairs without a separating direction: bodies mostly move towards each other by at
  // least this share of their motion bounds.
  constexpr double kTowardsShare = 0.25;
  const auto add = [&](int entry, bool box, double distance_m, double moves_a_m,
                       double moves_m) -> Undecided& {
    const NarrowPair pair = narrow(entry, box);
    const double short_m = pair.limit_m + kTowardsShare * moves_m - std::max(distance_m, 0.0);
    return s.undecided.emplace_back(Undecided{entry, box, distance_m, moves_a_m,
                                              moves_m - moves_a_m, pair.limit_m, slack_m(pair),
                                              short_m, moves_a_m, moves_m - moves_a_m});
  };
  if (is_self()) {
    for (const MotionTube::SelfHit& hit : a_->self_hits(s.nodes_a[lane])) {
      add(hit.pair, false, hit.distance, hit.motion_bound, hit.motion_bound);
    }
    return s.undecided;
  }
  const auto of_lane = [lane](const Scratch::Hits& hits, const auto& visit) {
    for (std::size_t h = 0; h < static_cast<std::size_t>(hits.count); ++h) {
      if ((hits.of[h].lanes >> lane & 1U) != 0) visit(h, hits.of[h]);
    }
  };
  const auto moves_a_m = [&](int row) {
    return s.side_a.motion_bound[static_cast<std::size_t>(row) * kLanes + lane];
  };
  of_lane(s.pairs, [&](std::size_t h, const filter::Hit& hit) {
    const int row = set.pairs[static_cast<std::size_t>(hit.pair)].row_a;
    Undecided& open =
        add(hit.pair, false, hit.distance[lane], moves_a_m(row), hit.motion_bound[lane]);
    const filter::Parted& parted = s.parted[h].of[lane];
    open.short_m = open.limit_m - static_cast<double>(parted.distance);
    open.towards_a_m = static_cast<double>(parted.towards[0]);
    open.towards_b_m = static_cast<double>(parted.towards[1]);
  });
  of_lane(s.boxes, [&](std::size_t, const filter::Hit& hit) {
    const int row = set.boxed[static_cast<std::size_t>(hit.capsule)].row;
    const int entry = hit.pair * static_cast<int>(set.boxed.size()) + hit.capsule;
    add(entry, true, hit.distance[lane], moves_a_m(row), hit.motion_bound[lane]);
  });
  return s.undecided;
}

}  // namespace armloom
