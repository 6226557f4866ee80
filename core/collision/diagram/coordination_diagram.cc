#include "core/collision/diagram/coordination_diagram.h"

#include <algorithm>
#include <utility>

#include "core/collision/filter/kernel.h"

namespace armloom {
struct CoordinationDiagram::Search {
  const ProgressBand& band;
  std::uint64_t budget;
  std::vector<Open> open;
  Answer answer;
  double conflict_at_s = ProgressBand::kUnbounded;   // of the earliest proven conflict
  double undecided_at_s = ProgressBand::kUnbounded;  // of the earliest cell that stays open
  int undecided = -1;

  void leave_open(const Open& cell) {
    if (cell.times.from >= undecided_at_s) return;
    undecided_at_s = cell.times.from;
    undecided = cell.cell;
  }
};

CoordinationDiagram::CoordinationDiagram(TubePair pair)
    : pair_(std::move(pair)),
      tree_(pair_.a(), pair_.is_self() ? std::make_shared<TimeTree>() : pair_.b()) {}

// ---- The cells ----

std::vector<CoordinationDiagram::CellView> CoordinationDiagram::cells() const {
  std::vector<CellView> views;
  for (const Node& cell : tree_) {
    if (cell.state != CellState::inner) views.push_back({tree_.box_of(cell), cell.state});
  }
  return views;
}

CoordinationDiagram::Witness CoordinationDiagram::witness_at(const Node& cell, PairId pair,
                                                             double distance_m) const {
  return {pair, distance_m, tree_.a().middle(cell.a), tree_.b().middle(cell.b), 0.0};
}

std::optional<TimeRange> CoordinationDiagram::meets(const ProgressBand& band,
                                                    const Node& cell) const {
  const ProgressBox box = tree_.box_of(cell);
  return armloom::meets(band, to_seconds(box.from_a), to_seconds(box.to_a), to_seconds(box.from_b),
                        to_seconds(box.to_b));
}

// Returns the proven conflict at the cell's middle, or null.
const CoordinationDiagram::NarrowWitness* CoordinationDiagram::proven(const Node& cell) const {
  if (cell.witness < 0) return nullptr;
  const NarrowWitness& found = found_[static_cast<std::size_t>(cell.witness)];
  return found.distance_m < pair_.narrow(found.narrow, found.box).limit_m ? &found : nullptr;
}

// ---- The question ----

// Adds to search.open the unknown leaves of this cell that the question needs. Notes known
// conflicts.
void CoordinationDiagram::collect(int index, Search& search) {
  const auto times = meets(search.band, tree_.at(index));
  if (!times || times->from > search.conflict_at_s - kFirst_s) return;
  if (tree_.at(index).state == CellState::free) return;
  const Open open{index, *times};
  tree_.split_if_wide(index);
  if (tree_.at(index).state == CellState::mixed || tree_.at(index).state == CellState::conflict) {
    consider_conflict(open, search);
    if (times->from > search.conflict_at_s - kFirst_s) return;
    if (tree_.at(index).state == CellState::mixed) tree_.split(index, tree_.at(index).levels);
  }
  switch (tree_.at(index).state) {
    case CellState::unknown:
      search.open.push_back(open);
      break;
    case CellState::conflict:  // not free, even if no conflict within the band is proven
      if (search.conflict_at_s <= times->to) break;
      [[fallthrough]];
    case CellState::finest:
      search.leave_open(open);
      break;
    case CellState::inner: {
      const Node cell = tree_.at(index);
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
  // A narrow band meets few combinations of the stretches of a wide cell. Halving is faster there.
  const bool is_narrow = !band.swept && pair_.b()->duration() > Duration{} &&
                         from_seconds(band.lag_a + band.lag_b) <= MotionTube::kStretch;
  const bool in_stretches = !is_narrow;
  collect(0, search);
  while (!search.open.empty() && !answer.exhausted) {
    now = std::exchange(search.open, {});
    for (std::size_t done = 0; done < now.size() && !answer.exhausted; done += batch.size()) {
      const std::size_t left =
          std::min<std::size_t>(now.size() - done, budget - answer.evaluations);
      answer.exhausted = left == 0 || !pair_.goes_on(left);
      for (std::size_t i = done; answer.exhausted && i < now.size(); ++i) search.leave_open(now[i]);
      batch.clear();
      while (batch.size() < std::min<std::size_t>(filter::kLanes, left)) {
        batch.push_back(now[done + batch.size()].cell);
      }
      if (!batch.empty()) evaluate(batch, in_stretches);
      answer.evaluations += batch.size();
    }
    if (answer.exhausted) break;
    for (const Open& open : now) collect(open.cell, search);
  }
  const bool undecided = search.undecided_at_s < search.conflict_at_s - kFirst_s;
  answer.proven = answer.conflict.has_value();
  answer.free = !undecided && !answer.proven;
  if (undecided && !answer.proven) {
    Witness witness = witness_at(tree_.at(search.undecided), PairId{0}, 0.0);
    const TubePair::PairDistance closest = pair_.closest_at(witness.time_a, witness.time_b);
    witness.pair = closest.pair;
    witness.distance_m = closest.distance_m;
    witness.at_s = search.undecided_at_s;
    answer.conflict = witness;
  }
  return answer;
}

// Notes the proven conflict at the cell's middle if the band contains this state. Otherwise checks
// the state in which both motions pass the cell as planned.
void CoordinationDiagram::consider_conflict(const Open& open, Search& search) {
  const Node& cell = tree_.at(open.cell);
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

// Returns the planned state at the middle of its time in the cell, or nullopt if this state is no
// conflict.
std::optional<CoordinationDiagram::Witness> CoordinationDiagram::on_the_line(
    const Open& open, const ProgressBand& band) {
  const Node& cell = tree_.at(open.cell);
  const NarrowWitness& found = found_[static_cast<std::size_t>(cell.witness)];
  const NarrowPair pair = pair_.narrow(found.narrow, found.box);
  const double until = std::min(open.times.to, open.times.from + to_seconds(tree_.a().duration()) +
                                                   to_seconds(tree_.b().duration()));
  const double t = 0.5 * (open.times.from + until);
  const auto place = [t](const TimeTree& axis, int node, double progress) {
    const Duration planned = std::clamp(from_seconds(progress + t), Duration{}, axis.duration());
    return std::clamp(planned, axis.from(node), axis.to(node));
  };
  Witness witness{found.pair, 0.0, place(tree_.a(), cell.a, band.progress_a),
                  place(tree_.b(), cell.b, band.progress_b), 0.0};
  const auto at_s = first_at(band, to_seconds(witness.time_a), to_seconds(witness.time_b));
  if (!at_s) return std::nullopt;
  witness.at_s = *at_s;
  pair_.place(witness.time_a, witness.time_b);
  witness.distance_m = pair_.placed_distance(pair, pair.limit_m);
  return witness.distance_m < pair.limit_m ? std::optional(witness) : std::nullopt;
}

}  // namespace armloom
