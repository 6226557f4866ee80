#include "core/collision/diagram/cell_tree.h"

#include <utility>

namespace armloom {

CellTree::CellTree(std::shared_ptr<TimeTree> a, std::shared_ptr<TimeTree> b)
    : a_(std::move(a)), b_(std::move(b)) {
  cells_.push_back({TimeTree::root(), TimeTree::root()});
}

ProgressBox CellTree::box_of(const Node& cell) const {
  return {a_->from(cell.a), a_->to(cell.a), b_->from(cell.b), b_->to(cell.b)};
}

void CellTree::split(int index, int levels) {
  const Node cell = at(index);
  const bool split_a = cell.split_a && a_->width(cell.a) > kFinest;
  const bool split_b = cell.split_b && b_->width(cell.b) > kFinest;
  if (!split_a && !split_b) {
    if (at(index).state == CellState::mixed) at(index).state = CellState::finest;
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
      Node child{first_a + i, first_b + j};
      child.split_a = cell.split_a;
      child.split_b = cell.split_b;
      cells_.push_back(child);
    }
  }
  if (levels <= 1) return;
  const int end = static_cast<int>(cells_.size());
  for (int child = children; child < end; ++child) split(child, levels - 1);
}

void CellTree::split_if_wide(int index, Duration wide) {
  Node& cell = at(index);
  if (cell.state != CellState::unknown || !wider(cell, wide)) return;
  cell.split_a = a_->width(cell.a) > wide;
  cell.split_b = b_->width(cell.b) > wide;
  split(index, 1);
}

void CellTree::split_if_coarse(int index, Duration resolution) {
  Node& cell = at(index);
  if (cell.state != CellState::mixed || !wider(cell, resolution)) return;
  const bool coarse_a = a_->width(cell.a) > resolution;
  const bool coarse_b = b_->width(cell.b) > resolution;
  const bool as_chosen = (cell.split_a && coarse_a) || (cell.split_b && coarse_b);
  cell.split_a = coarse_a && (cell.split_a || !as_chosen);
  cell.split_b = coarse_b && (cell.split_b || !as_chosen);
  split(index, 1);
}

}  // namespace armloom
