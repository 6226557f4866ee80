#include "core/collision/diagram/oriented_diagram.h"

#include <algorithm>
#include <utility>

namespace armloom {
namespace {

ProgressBox turned(const ProgressBox& box) { return {box.from_b, box.to_b, box.from_a, box.to_a}; }

ProgressBand turned(ProgressBand band) {
  std::swap(band.progress_a, band.progress_b);
  std::swap(band.lag_a, band.lag_b);
  std::swap(band.duration_a, band.duration_b);
  return band;
}

}  // namespace

struct OrientedDiagram::Parting {
  PairSet pairs;
  std::optional<CoordinationDiagram> cells;
};

CoordinationDiagram::Answer OrientedDiagram::ask(ProgressBand band, std::uint64_t budget) const {
  CoordinationDiagram::Answer answer = cells_->ask(turned_ ? turned(band) : band, budget);
  if (turned_ && answer.conflict) std::swap(answer.conflict->time_a, answer.conflict->time_b);
  return answer;
}

std::uint64_t OrientedDiagram::refine(Duration resolution, std::uint64_t budget) const {
  return cells_->refine(Duration{}, Duration{}, resolution, budget);
}

std::uint64_t OrientedDiagram::refine_outline(Duration now_a, Duration now_b,
                                              const CoordinationDiagram::Resolution& resolution,
                                              std::uint64_t budget) const {
  if (turned_) std::swap(now_a, now_b);
  return cells_->refine_outline(now_a, now_b, resolution, budget);
}

std::uint64_t OrientedDiagram::refine_close_passes(std::vector<ProgressBox> areas, Duration finest,
                                                   std::uint64_t budget) const {
  if (turned_)
    std::ranges::transform(areas, areas.begin(), [](const auto& b) { return turned(b); });
  return cells_->refine_close_passes(areas, finest, budget);
}

std::vector<CoordinationDiagram::Blocked> OrientedDiagram::blocked(Duration now_a,
                                                                   Duration now_b) const {
  if (!turned_) return cells_->blocked(now_a, now_b);
  auto leaves = cells_->blocked(now_b, now_a);
  for (CoordinationDiagram::Blocked& leaf : leaves) {
    leaf.box = turned(leaf.box);
    if (leaf.found) std::swap(leaf.found->time_a, leaf.found->time_b);
  }
  return leaves;
}

std::vector<CoordinationDiagram::CellView> OrientedDiagram::cells() const {
  auto views = cells_->cells();
  if (!turned_) return views;
  for (CoordinationDiagram::CellView& view : views) view.box = turned(view.box);
  return views;
}

CoordinationDiagram::Witness OrientedDiagram::closest_at(Duration time_a, Duration time_b) const {
  const TubePair::PairDistance closest = turned_ ? cells_->pair().closest_at(time_b, time_a)
                                                 : cells_->pair().closest_at(time_a, time_b);
  return {closest.pair, closest.distance_m, time_a, time_b, 0.0};
}

Proximity OrientedDiagram::proximity_of(const CoordinationDiagram::Witness& found) const {
  const PlanningScene::Bodies& bodies = *setting_.bodies;
  const BodyPair& pair = bodies.pairs[found.pair.index()];
  Proximity proximity =
      armloom::proximity_of(bodies.bodies[pair.a], bodies.bodies[pair.b], found.distance_m);
  proximity.limit_m = bodies.group_of(found.pair).limit_m(PairLimits::of(*bodies.cell));
  return turned_ ? turned_around(std::move(proximity)) : proximity;
}

bool OrientedDiagram::is_self(const CoordinationDiagram::Witness& found) const {
  return setting_.bodies->group_of(found.pair).kind == PairGroup::Kind::self;
}

OrientedDiagram OrientedDiagram::parting_at(Duration now_a, Duration now_b) const {
  if (turned_) std::swap(now_a, now_b);
  const std::vector<TubePair::PairDistance> near = cells_->pair().near_at(now_a, now_b);
  if (near.empty()) return {};
  auto parting = std::make_shared<Parting>(Parting{*setting_.pairs, std::nullopt});
  let_part(parting->pairs, near);
  const TubePair::Setting setting{setting_.bodies, &parting->pairs, setting_.scratch};
  parting->cells.emplace(cells_->pair().with(setting));
  OrientedDiagram apart(*parting->cells, setting, turned_);
  apart.parting_ = std::move(parting);
  return apart;
}

void OrientedDiagram::lower(ClearanceBound& bound) const {
  const auto look = [&](const NarrowPair& pair) {
    const bool self = setting_.bodies->group_of(pair.pair).kind == PairGroup::Kind::self;
    double& least_m = self ? bound.self_m : bound.apart_m;
    least_m = std::min(least_m, pair.limit_m);
  };
  std::ranges::for_each(setting_.pairs->narrow, look);
  setting_.pairs->each_boxed(look);
}

}  // namespace armloom
