#include "core/collision/check/pair_regions.h"

#include <algorithm>
#include <cmath>
#include <deque>

#include "core/collision/check/certificates.h"
#include "core/trajectory/set_joints.h"

namespace armloom {
namespace {

bool moves(const Motion& motion, ArmId arm) {
  const auto& arms = motion.trajectory->arms();
  return std::ranges::find(arms, arm) != arms.end();
}

bool share_an_arm(const Motion& a, const Motion& b) {
  return std::ranges::any_of(a.trajectory->arms(), [&](ArmId arm) { return moves(b, arm); });
}

void put(const Trajectory& trajectory, Duration time, Configuration& q) {
  Eigen::VectorXd position;
  trajectory.sample_positions(time, position);
  set_joints(q, trajectory, position);
}

bool holds(const CoordinationDiagram::Blocked& leaf, Duration a, Duration b) {
  const ProgressBox& box = leaf.box;
  return box.from_a <= a && a <= box.to_a && box.from_b <= b && b <= box.to_b;
}

}  // namespace

Duration PairRegionSearch::Side::now() const {
  return motion == nullptr ? Duration{} : std::clamp(motion->progress, Duration{}, end());
}

const CertifiedSide& PairRegionSearch::Side::certify() {
  if (!certified) certified = certified_side(arms, motion);
  return *certified;
}

std::uint64_t PairRegionSearch::cells_for(const Side& a, const Side& b) const {
  const auto usual = static_cast<std::uint64_t>(std::ceil(kCells * to_seconds(a.end() + b.end())));
  return std::min(question_.effort * usual, kCellsMax);
}

Duration PairRegionSearch::closest() const {
  return question_.effort > 1 ? CellTree::kFinest : kClosest;
}

CoordinationDiagram::Resolution PairRegionSearch::resolution_of(Duration shorter) {
  CoordinationDiagram::Resolution resolution = kResolution;
  const double scale = std::clamp(to_seconds(shorter) / to_seconds(kShort), 1.0, 2.0);
  for (Duration* width : {&resolution.fine, &resolution.passing.fine}) {
    *width = from_seconds(scale * to_seconds(*width));
  }
  return resolution;
}

PairRegionSearch::PairRegionSearch(MotionStore& store, const Question& question)
    : store_(store),
      question_(question),
      tracking_errors_(std::get<Coordinated>(question.method).tracking_errors) {
  for (const Motion& motion : question.others) in_order_.push_back(&motion);
  for (const Motion& motion : question.candidates) in_order_.push_back(&motion);
  std::ranges::stable_partition(in_order_, [](const Motion* motion) { return !motion->to_come; });
}

PairRegionSearch::Side PairRegionSearch::side_of(const Motion& motion) {
  Side side{motion.step, &motion, {}};
  for (const ArmId arm : motion.trajectory->arms()) {
    side.arms.push_back(&store_.motion(motion.trajectory, arm, question_.rest,
                                       std::max(tracking_errors_.of(arm), motion.off_path)));
  }
  return side;
}

PairRegionSearch::Side PairRegionSearch::resting(ArmId arm, const Configuration& rest) {
  return {arm, nullptr, {&store_.motion(nullptr, arm, rest, tracking_errors_.of(arm))}};
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
    Configuration rest = question_.rest;  // where the arm is now, not the start of its next motion
    if (before != nullptr) put(*before->trajectory, before->trajectory->duration(), rest);
    sides.push_back(resting(arm, rest));
  }
  return sides;
}

std::vector<PairRegions> PairRegionSearch::find() {
  std::vector<Side> candidates, others;
  for (const Motion& motion : question_.candidates) candidates.push_back(side_of(motion));
  for (const Motion& motion : question_.others) others.push_back(side_of(motion));
  std::deque<Side> rests;
  std::vector<std::pair<Side*, Side*>> pairs;
  for (auto own = candidates.begin(); own != candidates.end(); ++own) {
    for (Side& other : others) pairs.emplace_back(&*own, &other);
    for (auto other = own + 1; other != candidates.end(); ++other)
      pairs.emplace_back(&*own, &*other);
    for (Side& rest : standing_beside(*own->motion)) {
      pairs.emplace_back(&*own, &rests.emplace_back(std::move(rest)));
    }
  }
  std::uint64_t cells = 0;  // for outlines and close passes
  for (const auto& [a, b] : pairs) cells += 2 * cells_for(*a, *b) * a->arms.size() * b->arms.size();
  store_.expect(cells);
  std::vector<PairRegions> found;
  for (const auto& [a, b] : pairs) compare(*a, *b, found);
  return found;
}

void PairRegionSearch::compare(Side& a, Side& b, std::vector<PairRegions>& found) {
  if (b.motion != nullptr && share_an_arm(*a.motion, *b.motion)) return;
  layers_.clear();
  bool apart = true;  // if true, ApartCertificates cover the pair
  for (MotionStore::Entry* arm_a : a.arms) {
    for (MotionStore::Entry* arm_b : b.arms) {
      apart = apart && store_.out_of_reach(arm_a->arm, arm_b->arm);
      const OrientedDiagram layer = store_.between(*arm_a, *arm_b);
      if (layer) layers_.push_back(outlined(a, b, layer));
    }
  }
  if (store_.is_interrupted()) return;
  std::vector<BlockedRegion> regions = blocked(a, b);
  if (store_.is_interrupted()) return;
  if (refine_close_passes(regions, cells_for(a, b))) regions = blocked(a, b);
  if (store_.is_interrupted()) return;
  if (!apart) {
    std::vector<ProgressBox> boxes;
    for (const BlockedRegion& region : regions) {
      boxes.insert(boxes.end(), region.boxes.begin(), region.boxes.end());
    }
    certificates_.emplace_back(
        pair_certificate(*store_.scene(), a.certify(), b.certify(), std::move(boxes)));
  }
  if (regions.empty()) return;
  const bool may_get_more = cells_for(a, b) < kCellsMax;
  exhausted_ = exhausted_ ||
               (may_get_more && std::ranges::any_of(regions, [this](const BlockedRegion& region) {
                  return blocked_[region.evidence].evidence != BlockedCell::Evidence::proven;
                }));
  PairRegions& pair = found.emplace_back(PairRegions{a.motion->step, b.who, {}});
  for (BlockedRegion& region : regions) pair.regions.push_back(region_of(std::move(region)));
}

OrientedDiagram PairRegionSearch::outlined(const Side& a, const Side& b, OrientedDiagram layer) {
  const std::uint64_t budget = cells_for(a, b);
  const auto resolution = resolution_of(std::min(a.end(), b.end()));
  const auto refine = [&](const OrientedDiagram& cells) {
    evaluations_ += cells.refine_outline(a.now(), b.now(), resolution, budget);
  };
  refine(layer);
  if (!question_.may_part || a.to_come() || b.to_come()) return layer;
  const auto leaves = layer.blocked(a.now(), b.now());
  const bool stand_so =
      std::ranges::any_of(leaves, [&](const auto& leaf) { return holds(leaf, a.now(), b.now()); });
  if (!stand_so) return layer;
  const OrientedDiagram parting = layer.parting_at(a.now(), b.now());
  if (!parting) return layer;
  parting.lower(parted_);
  refine(parting);
  return parting;
}

// Returns the regions of states that are not free in at least one layer.
std::vector<BlockedRegion> PairRegionSearch::blocked(const Side& a, const Side& b) {
  blocked_.clear();
  leaves_.clear();
  for (std::size_t l = 0; l < layers_.size(); ++l) {
    for (const CoordinationDiagram::Blocked& leaf : layers_[l].blocked(a.now(), b.now())) {
      BlockedCell& cell = blocked_.emplace_back(BlockedCell{.box = leaf.box});
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

// Refines regions without a proven conflict, because motions may only pass each other closely
// there. Returns true if cells were evaluated.
bool PairRegionSearch::refine_close_passes(const std::vector<BlockedRegion>& regions,
                                           std::uint64_t budget) {
  std::uint64_t looked_at = 0;
  for (const BlockedRegion& region : regions) {
    if (blocked_[region.evidence].evidence == BlockedCell::Evidence::proven) continue;
    for (const OrientedDiagram& layer : layers_) {
      if (looked_at >= budget) break;
      looked_at += layer.refine_close_passes(region.boxes, closest(), budget - looked_at);
    }
  }
  evaluations_ += looked_at;
  return looked_at > 0;
}

ConflictRegion PairRegionSearch::region_of(BlockedRegion blocked) {
  const auto& [place, leaf] = leaves_[blocked.evidence];
  const OrientedDiagram& layer = layers_[place];
  const auto middle = [](Duration from, Duration to) { return from + (to - from) / 2; };
  const CoordinationDiagram::Witness found =
      leaf.found ? *leaf.found
                 : layer.closest_at(middle(leaf.box.from_a, leaf.box.to_a),
                                    middle(leaf.box.from_b, leaf.box.to_b));
  return {std::move(blocked.boxes), layer.proximity_of(found), found.time_a, found.time_b};
}

}  // namespace armloom
