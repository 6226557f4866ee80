#include "core/collision/pair_regions.h"

#include <algorithm>

#include "core/collision/arbiter.h"
#include "core/collision/parting.h"

namespace armloom {
namespace {

bool share_an_arm(const Motion& a, const Motion& b) {
  return std::ranges::any_of(a.trajectory->arms(), [&](ArmId arm) {
    return std::ranges::find(b.trajectory->arms(), arm) != b.trajectory->arms().end();
  });
}

bool holds(const CoordinationDiagram::Blocked& leaf, Duration a, Duration b) {
  return leaf.from_a <= a && a <= leaf.to_a && leaf.from_b <= b && b <= leaf.to_b;
}

}  // namespace

Duration PairRegionSearch::Side::now() const {
  return motion == nullptr ? Duration{} : std::clamp(motion->progress, Duration{}, end());
}

PairRegionSearch::PairRegionSearch(MotionStore& store, const Question& question)
    : store_(store),
      question_(question),
      tracking_error_(std::get<Coordinated>(question.method).tracking_error) {}

PairRegionSearch::Side PairRegionSearch::side_of(const Motion& motion) {
  Side side{motion.job, &motion, {}};
  for (const ArmId arm : motion.trajectory->arms()) {
    side.arms.push_back(&store_.motion(motion.trajectory, arm, question_.rest, tracking_error_));
  }
  return side;
}

PairRegionSearch::Side PairRegionSearch::resting(ArmId arm) {
  return {arm, nullptr, {&store_.motion(nullptr, arm, question_.rest, tracking_error_)}};
}

std::vector<PairRegions> PairRegionSearch::find() {
  std::vector<bool> moved(store_.scene()->cell().arms.size(), false);
  std::vector<Side> candidates, counterparts;
  const auto add = [&](const Motion& motion, std::vector<Side>& sides) {
    for (const ArmId arm : motion.trajectory->arms()) moved[arm.index()] = true;
    sides.push_back(side_of(motion));
  };
  for (const Motion& motion : question_.candidates) add(motion, candidates);
  for (const Motion& motion : question_.others) add(motion, counterparts);
  const std::size_t others = counterparts.size();
  for (std::uint32_t arm = 0; arm < moved.size(); ++arm) {
    if (!moved[arm]) counterparts.push_back(resting(ArmId{arm}));
  }
  std::vector<PairRegions> found;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    for (std::size_t k = 0; k < others; ++k) compare(candidates[i], counterparts[k], found);
    for (std::size_t k = i + 1; k < candidates.size(); ++k) {
      compare(candidates[i], candidates[k], found);
    }
    for (std::size_t k = others; k < counterparts.size(); ++k) {
      compare(candidates[i], counterparts[k], found);
    }
  }
  return found;
}

void PairRegionSearch::compare(const Side& a, const Side& b, std::vector<PairRegions>& found) {
  if (b.motion != nullptr && share_an_arm(*a.motion, *b.motion)) return;
  layers_.clear();
  partings_.clear();
  blocked_.clear();
  leaves_.clear();
  for (MotionStore::Entry* arm_a : a.arms) {
    for (MotionStore::Entry* arm_b : b.arms) add_layer(a, *arm_a, b, *arm_b);
  }
  std::vector<BlockedRegion> regions =
      blocked_regions(blocked_, {a.now(), a.end(), b.now(), b.end()});
  if (regions.empty()) return;
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
  const double longest_s = to_seconds(std::max(a.end(), b.end()));
  const auto budget = static_cast<std::uint64_t>(kCells * std::max(1.0, longest_s / 10.0));
  const auto look = [&](CoordinationDiagram& cells) {
    evaluations_ += cells.refine_outline(first.now(), second.now(), kResolution, budget);
    return cells.blocked(first.now(), second.now());
  };
  CoordinationDiagram* cells = diagram.cells;
  std::vector<CoordinationDiagram::Blocked> leaves = look(*cells);
  const bool stand_so = !a.to_come() && !b.to_come();
  if (stand_so && std::ranges::any_of(leaves, [&](const auto& leaf) {
        return holds(leaf, first.now(), second.now());
      })) {
    const auto close = cells->too_close_at(first.now(), second.now());
    if (!close.empty()) {
      Parting& parting = *partings_.emplace_back(std::make_unique<Parting>());
      parting.pairs = held_to_less(*diagram.pairs, close, Arbiter::kPartingShare);
      parting.cells = store_.with_pairs(diagram, parting.pairs);
      cells = &*parting.cells;
      leaves = look(*cells);
    }
  }
  for (const CoordinationDiagram::Blocked& leaf : leaves) {
    BlockedCell& blocked = blocked_.emplace_back();
    blocked.box = turned ? ProgressBox{leaf.from_b, leaf.to_b, leaf.from_a, leaf.to_a}
                         : ProgressBox{leaf.from_a, leaf.to_a, leaf.from_b, leaf.to_b};
    if (leaf.found) {
      blocked.evidence =
          leaf.proven ? BlockedCell::Evidence::proven : BlockedCell::Evidence::distance;
      blocked.distance_m = leaf.found->distance_m;
    }
    leaves_.emplace_back(layers_.size(), leaf);
  }
  layers_.push_back({cells, diagram.bodies, turned});
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
