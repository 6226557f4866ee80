#include "core/collision/diagram/coordination_diagram.h"

#include <algorithm>
#include <utility>

#include "core/collision/filter/kernel.h"

namespace armloom {
// One question on its way.
struct CoordinationDiagram::Search {
  const ProgressBand& band;
  std::uint64_t budget;
  std::vector<Open> open;
  Answer answer;
  double conflict_at_s = ProgressBand::kUnbounded;   // of the earliest that is proven
  double undecided_at_s = ProgressBand::kUnbounded;  // of the earliest cell that cannot be refined
  int undecided = -1;

  void leave_open(const Open& cell) {
    if (cell.times.from >= undecided_at_s) return;
    undecided_at_s = cell.times.from;
    undecided = cell.cell;
  }
};

CoordinationDiagram::CoordinationDiagram(TubePair pair)
    : pair_(std::move(pair)),
      a_(pair_.a()),
      b_(pair_.is_self() ? std::make_shared<TimeTree>() : pair_.b()) {
  cells_.push_back({TimeTree::root(), TimeTree::root()});
}

// ---- The tree ----

ProgressBox CoordinationDiagram::box_of(const DiagramNode& cell) const {
  return {a_->from(cell.a), a_->to(cell.a), b_->from(cell.b), b_->to(cell.b)};
}

std::vector<CoordinationDiagram::CellView> CoordinationDiagram::cells() const {
  std::vector<CellView> views;
  for (const DiagramNode& cell : cells_) {
    if (cell.state != CellState::inner) views.push_back({box_of(cell), cell.state});
  }
  return views;
}

CoordinationDiagram::Witness CoordinationDiagram::witness_at(const DiagramNode& cell, PairId pair,
                                                             double distance_m) const {
  return {pair, distance_m, a_->middle(cell.a), b_->middle(cell.b), 0.0};
}

std::optional<TimeRange> CoordinationDiagram::meets(const ProgressBand& band,
                                                    const DiagramNode& cell) const {
  const ProgressBox box = box_of(cell);
  return armloom::meets(band, to_seconds(box.from_a), to_seconds(box.to_a), to_seconds(box.from_b),
                        to_seconds(box.to_b));
}

bool CoordinationDiagram::wider(const DiagramNode& cell, Duration resolution) const {
  return a_->width(cell.a) > resolution || b_->width(cell.b) > resolution;
}

// An unknown cell that is hardly free in one is split before it is looked at.
void CoordinationDiagram::split_if_wide(int index) {
  DiagramNode& cell = at(index);
  if (cell.state != CellState::unknown || !wider(cell, kWide)) return;
  cell.split_a = a_->width(cell.a) > kWide;
  cell.split_b = b_->width(cell.b) > kWide;
  split(index, 1);
}

// As the cell's split_a, split_b say; children of further levels likewise.
void CoordinationDiagram::split(int index, int levels) {
  const DiagramNode cell = at(index);
  const bool split_a = cell.split_a && a_->width(cell.a) > kFinest;
  const bool split_b = cell.split_b && b_->width(cell.b) > kFinest;
  if (!split_a && !split_b) {
    at(index).state = CellState::finest;
    return;
  }
  const int children = static_cast<int>(cells_.size());
  at(index).children = children;
  at(index).state = CellState::inner;
  at(index).split_a = split_a;
  at(index).split_b = split_b;
  const int first_a = split_a ? a_->first_child(cell.a) : cell.a;
  const int first_b = split_b ? b_->first_child(cell.b) : cell.b;
  for (int i = 0; i < (split_a ? 2 : 1); ++i) {
    for (int j = 0; j < (split_b ? 2 : 1); ++j) {
      DiagramNode child{first_a + i, first_b + j};
      child.split_a = cell.split_a;
      child.split_b = cell.split_b;
      cells_.push_back(child);
    }
  }
  if (levels <= 1) return;
  const int end = static_cast<int>(cells_.size());
  for (int child = children; child < end; ++child) {
    if (wider(at(child), kFinest)) split(child, levels - 1);
  }
}

// Where the side that moves more is fine already, the other one is halved.
void CoordinationDiagram::split_if_coarse(int index, Duration resolution) {
  DiagramNode& cell = at(index);
  if (cell.state != CellState::mixed || !wider(cell, resolution)) return;
  const bool coarse_a = a_->width(cell.a) > resolution;
  const bool coarse_b = b_->width(cell.b) > resolution;
  const bool as_chosen = (cell.split_a && coarse_a) || (cell.split_b && coarse_b);
  cell.split_a = coarse_a && (cell.split_a || !as_chosen);
  cell.split_b = coarse_b && (cell.split_b || !as_chosen);
  split(index, 1);
}

// The conflict at the cell's middle.
const CoordinationDiagram::NarrowWitness* CoordinationDiagram::proven(
    const DiagramNode& cell) const {
  if (cell.witness < 0) return nullptr;
  const NarrowWitness& found = found_[static_cast<std::size_t>(cell.witness)];
  return found.distance_m < pair_.narrow(found.narrow, found.box).limit_m ? &found : nullptr;
}

// ---- The question ----

// Adds the unknown leaves below the cell that the question needs; takes note of what is known.
void CoordinationDiagram::collect(int index, Search& search) {
  const auto times = meets(search.band, at(index));
  if (!times || times->from > search.conflict_at_s - kFirst_s) return;
  if (at(index).state == CellState::free) return;
  const Open open{index, *times};
  split_if_wide(index);
  if (at(index).state == CellState::mixed || at(index).state == CellState::conflict) {
    consider_conflict(open, search);
    if (times->from > search.conflict_at_s - kFirst_s) return;
    if (at(index).state == CellState::mixed) split(index, at(index).levels);
  }
  switch (at(index).state) {
    case CellState::unknown:
      search.open.push_back(open);
      break;
    case CellState::conflict:  // none of whose states is known to be the region's: still not free
      if (search.conflict_at_s <= times->to) break;
      [[fallthrough]];
    case CellState::finest:
      search.leave_open(open);
      break;
    case CellState::inner: {
      const DiagramNode cell = at(index);
      for (int i = 0; i < cell.child_count(); ++i) collect(cell.children + i, search);
      break;
    }
    default:
      break;
  }
}

CoordinationDiagram::Answer CoordinationDiagram::ask(const ProgressBand& band,
                                                     std::uint64_t budget) {
  Search search{.band = band, .budget = budget, .open = {}, .answer = {}};
  Answer& answer = search.answer;
  std::vector<Open> now;
  std::vector<int> batch;
  collect(0, search);
  while (!search.open.empty() && !answer.exhausted) {
    now = std::exchange(search.open, {});
    for (std::size_t done = 0; done < now.size() && !answer.exhausted; done += batch.size()) {
      const std::size_t left =
          std::min<std::size_t>(now.size() - done, budget - answer.evaluations);
      answer.exhausted = left == 0;
      for (std::size_t i = done; answer.exhausted && i < now.size(); ++i) search.leave_open(now[i]);
      batch.clear();
      while (batch.size() < std::min<std::size_t>(filter::kLanes, left)) {
        batch.push_back(now[done + batch.size()].cell);
      }
      if (!batch.empty()) evaluate(batch);
      answer.evaluations += batch.size();
    }
    if (answer.exhausted) break;
    for (const Open& open : now) collect(open.cell, search);
  }
  const bool undecided = search.undecided_at_s < search.conflict_at_s - kFirst_s;
  answer.proven = answer.conflict.has_value();
  answer.free = !undecided && !answer.proven;
  if (undecided && !answer.proven) {
    Witness witness = witness_at(at(search.undecided), PairId{0}, 0.0);
    const TubePair::PairDistance closest = pair_.closest_at(witness.time_a, witness.time_b);
    witness.pair = closest.pair;
    witness.distance_m = closest.distance_m;
    witness.at_s = search.undecided_at_s;
    answer.conflict = witness;
  }
  return answer;
}

// A cell with a conflict at its middle: is that, or what the plan passes in the cell, one of the
// question's band?
void CoordinationDiagram::consider_conflict(const Open& open, Search& search) {
  const DiagramNode& cell = at(open.cell);
  const NarrowWitness* found = proven(cell);
  if (found == nullptr) return;
  std::optional<Witness> witness = witness_at(cell, found->pair, found->distance_m);
  if (const auto at_s =
          first_at(search.band, to_seconds(witness->time_a), to_seconds(witness->time_b))) {
    witness->at_s = *at_s;
  } else if (search.answer.evaluations < search.budget) {
    ++search.answer.evaluations;
    witness = on_the_line(open, search.band);
  } else {
    return;
  }
  if (!witness || witness->at_s >= search.conflict_at_s) return;
  search.conflict_at_s = witness->at_s;
  search.answer.conflict = witness;
}

// The state that the plan itself passes in the middle of its time in the cell.
std::optional<CoordinationDiagram::Witness> CoordinationDiagram::on_the_line(
    const Open& open, const ProgressBand& band) {
  const DiagramNode& cell = at(open.cell);
  const NarrowWitness& found = found_[static_cast<std::size_t>(cell.witness)];
  const NarrowPair& pair = pair_.narrow(found.narrow, found.box);
  const double until = std::min(
      open.times.to, open.times.from + to_seconds(a_->duration()) + to_seconds(b_->duration()));
  const double t = 0.5 * (open.times.from + until);
  const auto place = [t](const TimeTree& axis, int node, double progress) {
    const Duration planned = std::clamp(from_seconds(progress + t), Duration{}, axis.duration());
    return std::clamp(planned, axis.from(node), axis.to(node));
  };
  Witness witness{found.pair, 0.0, place(*a_, cell.a, band.progress_a),
                  place(*b_, cell.b, band.progress_b), 0.0};
  const auto at_s = first_at(band, to_seconds(witness.time_a), to_seconds(witness.time_b));
  if (!at_s) return std::nullopt;
  witness.at_s = *at_s;
  pair_.place(witness.time_a, witness.time_b);
  witness.distance_m = pair_.placed_distance(pair, pair.limit_m);
  return witness.distance_m < pair.limit_m ? std::optional(witness) : std::nullopt;
}

}  // namespace armloom
