#include "core/collision/pair_regions.h"

#include <algorithm>
#include <cmath>

#include "core/collision/arbiter.h"
#include "core/collision/parting.h"

namespace armloom {
namespace {

bool moves(const Motion& motion, ArmId arm) {
  const auto& arms = motion.trajectory->arms();
  return std::ranges::find(arms, arm) != arms.end();
}

bool share_an_arm(const Motion& a, const Motion& b) {
  return std::ranges::any_of(a.trajectory->arms(), [&](ArmId arm) { return moves(b, arm); });
}

// Where the trajectory's joints are at that time.
void put(const Trajectory& trajectory, Duration time, Configuration& q) {
  Eigen::VectorXd position;
  trajectory.sample_positions(time, position);
  for (std::size_t j = 0; j < trajectory.joints().size(); ++j) {
    q[static_cast<Eigen::Index>(trajectory.joints()[j].index())] =
        position[static_cast<Eigen::Index>(j)];
  }
}

bool holds(const CoordinationDiagram::Blocked& leaf, Duration a, Duration b) {
  return leaf.from_a <= a && a <= leaf.to_a && leaf.from_b <= b && b <= leaf.to_b;
}

}  // namespace

Duration PairRegionSearch::Side::now() const {
  return motion == nullptr ? Duration{} : std::clamp(motion->progress, Duration{}, end());
}

std::uint64_t PairRegionSearch::cells_for(const Side& a, const Side& b) const {
  return question_.effort *
         static_cast<std::uint64_t>(std::ceil(kCells * to_seconds(a.end() + b.end())));
}

Duration PairRegionSearch::closest() const {
  return question_.effort > 1 ? CoordinationDiagram::kFinest : kClosest;
}

PairRegionSearch::PairRegionSearch(MotionStore& store, const Question& question)
    : store_(store),
      question_(question),
      tracking_error_(std::get<Coordinated>(question.method).tracking_error),
      least_limit_m_(store.scene()->cell().clearance_m) {
  for (const Motion& motion : question.others) in_order_.push_back(&motion);
  for (const Motion& motion : question.candidates) in_order_.push_back(&motion);
  std::ranges::stable_partition(in_order_, [](const Motion* motion) { return !motion->to_come; });
}

PairRegionSearch::Side PairRegionSearch::side_of(const Motion& motion) {
  Side side{motion.job, &motion, {}};
  for (const ArmId arm : motion.trajectory->arms()) {
    side.arms.push_back(&store_.motion(motion.trajectory, arm, question_.rest, tracking_error_));
  }
  return side;
}

PairRegionSearch::Side PairRegionSearch::resting(ArmId arm, const Configuration& rest) {
  return {arm, nullptr, {&store_.motion(nullptr, arm, rest, tracking_error_)}};
}

std::vector<PairRegionSearch::Side> PairRegionSearch::standing_beside(const Motion& candidate) {
  std::vector<Side> sides;
  const auto own = std::ranges::find(in_order_, &candidate);
  for (std::uint32_t a = 0; a < store_.scene()->cell().arms.size(); ++a) {
    const ArmId arm{a};
    const auto& own_arms = candidate.trajectory->arms();
    const bool apart = std::ranges::all_of(
        own_arms, [&](ArmId own_arm) { return store_.out_of_reach(own_arm, arm); });
    if (apart || moves(candidate, arm)) continue;
    const Motion* before = nullptr;
    const Motion* behind = nullptr;
    for (auto motion = in_order_.begin(); motion != in_order_.end(); ++motion) {
      if (!moves(**motion, arm)) continue;
      if (motion < own) before = *motion;
      if (motion > own && behind == nullptr) behind = *motion;
    }
    const auto compared = [&](const Motion* motion) {
      return motion != nullptr && !share_an_arm(candidate, *motion);
    };
    if (compared(before) || compared(behind)) continue;
    Configuration rest = question_.rest;
    if (before != nullptr) {
      put(*before->trajectory, before->trajectory->duration(), rest);
    } else if (behind != nullptr) {
      put(*behind->trajectory, Duration{}, rest);
    }
    sides.push_back(resting(arm, rest));
  }
  return sides;
}

std::vector<PairRegions> PairRegionSearch::find() {
  std::vector<Side> candidates, others;
  for (const Motion& motion : question_.candidates) candidates.push_back(side_of(motion));
  for (const Motion& motion : question_.others) others.push_back(side_of(motion));
  std::vector<PairRegions> found;
  for (auto own = candidates.begin(); own != candidates.end(); ++own) {
    for (const Side& other : others) compare(*own, other, found);
    for (auto other = own + 1; other != candidates.end(); ++other) compare(*own, *other, found);
    for (const Side& rest : standing_beside(*own->motion)) compare(*own, rest, found);
  }
  return found;
}

void PairRegionSearch::compare(const Side& a, const Side& b, std::vector<PairRegions>& found) {
  if (b.motion != nullptr && share_an_arm(*a.motion, *b.motion)) return;
  layers_.clear();
  partings_.clear();
  for (MotionStore::Entry* arm_a : a.arms) {
    for (MotionStore::Entry* arm_b : b.arms) add_layer(a, *arm_a, b, *arm_b);
  }
  std::vector<BlockedRegion> regions = blocked(a, b);
  if (look_closer(regions, cells_for(a, b))) regions = blocked(a, b);
  if (regions.empty()) return;
  exhausted_ = exhausted_ || std::ranges::any_of(regions, [this](const BlockedRegion& region) {
                 return blocked_[region.evidence].evidence != BlockedCell::Evidence::proven;
               });
  PairRegions& pair = found.emplace_back(PairRegions{a.motion->job, b.who, {}});
  for (BlockedRegion& region : regions) pair.regions.push_back(region_of(std::move(region)));
}

void PairRegionSearch::add_layer(const Side& a, MotionStore::Entry& arm_a, const Side& b,
                                 MotionStore::Entry& arm_b) {
  if (store_.out_of_reach(arm_a.arm, arm_b.arm)) return;
  const bool turned = arm_b.arm < arm_a.arm;
  const MotionStore::Diagram diagram =
      turned ? store_.pair(arm_b, arm_a) : store_.pair(arm_a, arm_b);
  if (diagram.pairs->empty()) return;
  const Side& first = turned ? b : a;
  const Side& second = turned ? a : b;
  const std::uint64_t budget = cells_for(a, b);
  const auto look = [&](CoordinationDiagram& cells) {
    evaluations_ += cells.refine_outline(first.now(), second.now(), kResolution, budget);
    return cells.blocked(first.now(), second.now());
  };
  CoordinationDiagram* cells = diagram.cells;
  const std::vector<CoordinationDiagram::Blocked> leaves = look(*cells);
  const bool stand_so = !a.to_come() && !b.to_come();
  if (stand_so && std::ranges::any_of(leaves, [&](const auto& leaf) {
        return holds(leaf, first.now(), second.now());
      })) {
    const auto close = cells->too_close_at(first.now(), second.now());
    if (!close.empty()) {
      Parting& parting = *partings_.emplace_back(std::make_unique<Parting>());
      parting.pairs = held_to_less(*diagram.pairs, close, Arbiter::kPartingShare);
      parting.cells = store_.with_pairs(diagram, parting.pairs);
      least_limit_m_ = armloom::least_limit_m(*diagram.bodies, parting.pairs, least_limit_m_);
      cells = &*parting.cells;
      look(*cells);
    }
  }
  layers_.push_back({cells, diagram.bodies, turned});
}

// What is not free in any of the layers, in components.
std::vector<BlockedRegion> PairRegionSearch::blocked(const Side& a, const Side& b) {
  blocked_.clear();
  leaves_.clear();
  for (std::size_t l = 0; l < layers_.size(); ++l) {
    const Layer& layer = layers_[l];
    const Side& first = layer.turned ? b : a;
    const Side& second = layer.turned ? a : b;
    for (const CoordinationDiagram::Blocked& leaf :
         layer.cells->blocked(first.now(), second.now())) {
      BlockedCell& cell = blocked_.emplace_back();
      cell.box = layer.turned ? ProgressBox{leaf.from_b, leaf.to_b, leaf.from_a, leaf.to_a}
                              : ProgressBox{leaf.from_a, leaf.to_a, leaf.from_b, leaf.to_b};
      if (leaf.found) {
        cell.evidence =
            leaf.proven ? BlockedCell::Evidence::proven : BlockedCell::Evidence::distance;
        cell.distance_m = leaf.found->distance_m;
      }
      leaves_.emplace_back(l, leaf);
    }
  }
  return blocked_regions(blocked_, {a.now(), a.end(), b.now(), b.end()});
}

// At regions in which no conflict is proven: motions may pass each other closely there. Whether
// anything is known now that was not before.
bool PairRegionSearch::look_closer(const std::vector<BlockedRegion>& regions,
                                   std::uint64_t budget) {
  std::uint64_t looked_at = 0;
  for (const BlockedRegion& region : regions) {
    if (blocked_[region.evidence].evidence == BlockedCell::Evidence::proven) continue;
    for (const Layer& layer : layers_) {
      std::vector<CoordinationDiagram::Area> areas;
      for (const ProgressBox& box : region.boxes) {
        areas.push_back(
            layer.turned ? CoordinationDiagram::Area{box.from_b, box.to_b, box.from_a, box.to_a}
                         : CoordinationDiagram::Area{box.from_a, box.to_a, box.from_b, box.to_b});
      }
      if (looked_at >= budget) break;
      looked_at += layer.cells->look_closer(areas, closest(), budget - looked_at);
    }
  }
  evaluations_ += looked_at;
  return looked_at > 0;
}

ConflictRegion PairRegionSearch::region_of(BlockedRegion blocked) {
  const auto& [layer_index, leaf] = leaves_[blocked.evidence];
  const Layer& layer = layers_[layer_index];
  CoordinationDiagram::Finding found{PairId{0}, 0.0, {}, {}, 0.0};
  if (leaf.found) {
    found = *leaf.found;
  } else {
    found.time_a = leaf.from_a + (leaf.to_a - leaf.from_a) / 2;
    found.time_b = leaf.from_b + (leaf.to_b - leaf.from_b) / 2;
    const CoordinationDiagram::Close closest = layer.cells->closest_at(found.time_a, found.time_b);
    found.pair = closest.pair;
    found.distance_m = closest.distance_m;
  }
  const PartPair& pair = layer.bodies->pairs[found.pair.index()];
  Proximity proximity =
      proximity_of(layer.bodies->parts[pair.a], layer.bodies->parts[pair.b], found.distance_m);
  if (!layer.turned) {
    return {std::move(blocked.boxes), std::move(proximity), found.time_a, found.time_b};
  }
  return {std::move(blocked.boxes), turned_around(std::move(proximity)), found.time_b,
          found.time_a};
}

}  // namespace armloom
