#include <algorithm>
#include <limits>

#include "core/collision/diagram/coordination_diagram.h"

namespace armloom {
namespace {

// A cell is halved along both axes if the smaller motion is at least this share of the larger.
constexpr double kBothShare = 0.5;

// Bodies mostly move towards each other by at least this share of their motion bounds. If their
// distance exceeds the limit by less, no proof is tried.
constexpr double kTowardsShare = 0.25;

// Surface distances above the limit may be too small by this share of the motion, which saves time.
constexpr double kRoughShare = 0.125;

}  // namespace

TubePair::Nodes CoordinationDiagram::nodes_of(const Node& cell) const {
  return {cell.a, pair_.is_self() ? cell.a : cell.b};
}

// Precondition: at most eight cells.
void CoordinationDiagram::evaluate(std::span<const int> cells, bool in_stretches) {
  TubePair::Nodes nodes[filter::kLanes];
  for (std::size_t i = 0; i < cells.size(); ++i) nodes[i] = nodes_of(tree_.at(cells[i]));
  pair_.filter({nodes, cells.size()}, in_stretches);
  for (std::size_t i = 0; i < cells.size(); ++i) decide(cells[i], pair_.undecided(i));
}

// Returns true if the pair is proven to keep its limit throughout the cell. If the capsules keep
// the limit at the middle, the middle cannot be a conflict. Then no exact distance is computed, and
// only the separating direction is tried.
bool CoordinationDiagram::clears(Node& cell, TubePair::Undecided& u) {
  const NarrowPair pair = pair_.narrow(u.narrow, u.box);
  const double enough_m = u.limit_m + u.moves_m();
  const bool may_conflict = u.distance_m < u.limit_m;
  if (may_conflict) {
    u.distance_m =
        pair_.distance(pair, nodes_of(cell), enough_m, {u.limit_m, kRoughShare * u.moves_m()});
    u.slack_m = 0.0;
    if (u.distance_m >= enough_m) return true;
  }
  const bool asked = !may_conflict || u.distance_m - u.limit_m > kTowardsShare * u.moves_m();
  if (asked && pair_.keeps_apart(pair, nodes_of(cell), u.limit_m, enough_m)) return true;
  if (may_conflict) note(cell, {pair.pair, u.narrow, u.box, u.distance_m});
  return false;
}

void CoordinationDiagram::decide(int index, std::vector<TubePair::Undecided>& undecided) {
  using Undecided = TubePair::Undecided;
  Node& cell = tree_.at(index);
  cell.state = CellState::free;
  if (undecided.empty()) return;

  // A pair that is in conflict throughout the cell decides the cell. If a pair is proven neither in
  // conflict nor apart, the cell must be split.
  constexpr double kProven = -std::numeric_limits<double>::infinity();
  const auto passes = [&](Undecided& u) {
    if (u.short_m == kProven) return true;
    if (clears(cell, u)) {
      u.short_m = kProven;
      return true;
    }
    if (u.distance_m + u.moves_m() < u.limit_m) {
      cell.state = CellState::conflict;
    } else {
      choose_split(cell, u);
    }
    return false;
  };
  // This pair is most likely in conflict, unless one body is in a notch of the other.
  const auto closest = std::ranges::min_element(
      undecided, {}, [](const Undecided& u) { return u.distance_m + u.slack_m - u.limit_m; });
  if (closest->distance_m + closest->slack_m < closest->limit_m && !passes(*closest)) return;
  const auto worst = std::ranges::max_element(undecided, {}, &Undecided::needs_m);
  if (worst->needs_m() > TubePair::kAlongShapes_m) {  // no exact distance can prove the pair apart
    choose_split(cell, *worst);
    return;
  }
  std::iter_swap(undecided.begin(), worst);  // most likely the pair that fails
  for (Undecided& u : undecided) {
    if (!passes(u)) return;
  }
}

// Keeps the pair if it is the closest found at the cell's middle.
void CoordinationDiagram::note(Node& cell, const NarrowWitness& found) {
  if (cell.witness < 0) {
    cell.witness = static_cast<int>(found_.size());
    found_.push_back(found);
  } else if (found.distance_m < found_[static_cast<std::size_t>(cell.witness)].distance_m) {
    found_[static_cast<std::size_t>(cell.witness)] = found;
  }
}

void CoordinationDiagram::choose_split(Node& cell, const TubePair::Undecided& worst) {
  cell.split_a = worst.towards_a_m >= kBothShare * worst.towards_b_m;
  cell.split_b = worst.towards_b_m >= kBothShare * worst.towards_a_m;
  if (!(cell.split_a && tree_.a().width(cell.a) > CellTree::kFinest) &&
      !(cell.split_b && tree_.b().width(cell.b) > CellTree::kFinest)) {
    cell.split_a = cell.split_b = true;  // whichever is still wide enough
  }
  const double room_m = worst.distance_m + worst.slack_m - worst.limit_m;
  const double shrink = room_m > 0.0 ? worst.moves_m() / room_m : 2.0;
  cell.levels = shrink > 6.0 ? 2 : 1;
  cell.state = tree_.wider(cell, CellTree::kFinest) ? CellState::mixed : CellState::finest;
}

}  // namespace armloom
