#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/collision/diagram/time_tree.h"
#include "core/coordination/conflict_region.h"

namespace armloom {

// The cells of a diagram, as a tree. A cell is a rectangle: an interval of A's time and an interval
// of B's time. Splitting halves a cell along one axis or both. The first cell covers both motions
// completely. The children of a cell are consecutive.
class CellTree {
 public:
  // States of a cell:
  // - unknown: not evaluated
  // - free, conflict: proven for every state of the cell
  // - mixed: neither is proven, so the cell must be split
  // - finest: neither is proven, and the cell is too small to be split
  // - inner: the cell was split
  enum class CellState : std::uint8_t { unknown, free, mixed, conflict, finest, inner };
  struct Node {
    int a;  // nodes of the axes (TimeTree)
    int b;
    int children = -1;  // first of two or four children, or -1
    CellState state = CellState::unknown;
    bool split_a = false;  // mixed: halve along A; inner: was halved along A
    bool split_b = false;
    std::uint8_t levels = 1;  // mixed: number of halvings at once
    int witness = -1;         // closest pair found at its middle (CoordinationDiagram), or -1

    [[nodiscard]] int child_count() const { return (split_a ? 2 : 1) * (split_b ? 2 : 1); }
  };

  // Wider cells are hardly ever free as a whole. So they are halved without being evaluated.
  inline static constexpr Duration kWide = std::chrono::milliseconds(700);
  // Cells are not split below this width.
  inline static constexpr Duration kFinest = std::chrono::microseconds(500);

  CellTree(std::shared_ptr<TimeTree> a, std::shared_ptr<TimeTree> b);

  // References stay valid until the next split.
  [[nodiscard]] Node& at(int cell) { return cells_[static_cast<std::size_t>(cell)]; }
  [[nodiscard]] const Node& at(int cell) const { return cells_[static_cast<std::size_t>(cell)]; }
  [[nodiscard]] int size() const { return static_cast<int>(cells_.size()); }
  [[nodiscard]] auto begin() const { return cells_.begin(); }
  [[nodiscard]] auto end() const { return cells_.end(); }

  [[nodiscard]] const TimeTree& a() const { return *a_; }
  [[nodiscard]] const TimeTree& b() const { return *b_; }
  [[nodiscard]] ProgressBox box_of(const Node& cell) const;
  [[nodiscard]] bool wider(const Node& cell, Duration than) const {
    return a_->width(cell.a) > than || b_->width(cell.b) > than;
  }
  // Returns true if neither motion has completely passed the cell.
  [[nodiscard]] bool remains(const Node& cell, Duration now_a, Duration now_b) const {
    return a_->to(cell.a) >= now_a && b_->to(cell.b) >= now_b;
  }

  // Halves the cell along the axes that split_a and split_b select. If these axes are too narrow, a
  // mixed cell becomes `finest`, and an unknown cell stays unknown. Splits the children too if
  // `levels` > 1.
  void split(int cell, int levels);
  // Splits the cell, without evaluating it, if it is unknown and wider than `wide` (at least
  // kWide).
  void split_if_wide(int cell, Duration wide = kWide);
  // Splits the cell if it is mixed and wider than `resolution`. If the preferred axis is fine
  // enough already, halves the other axis.
  void split_if_coarse(int cell, Duration resolution);

  // Calls visit(leaf) for leaves that touch `of`, corners included, until visit returns true.
  // Returns true if visit did.
  template <class Visit>
  bool leaves_at(const Node& of, const Visit& visit) const {
    std::vector<int>& open = walk_;
    open.assign(1, 0);
    while (!open.empty()) {
      const int index = open.back();
      open.pop_back();
      const Node& cell = at(index);
      const bool touch = a_->from(cell.a) <= a_->to(of.a) && a_->to(cell.a) >= a_->from(of.a) &&
                         b_->from(cell.b) <= b_->to(of.b) && b_->to(cell.b) >= b_->from(of.b);
      if (!touch) continue;
      if (cell.state != CellState::inner) {
        if (visit(index)) return true;
        continue;
      }
      for (int i = 0; i < cell.child_count(); ++i) open.push_back(cell.children + i);
    }
    return false;
  }

  // Calls visit(leaf) for each leaf, if descend(box) is true for the leaf and all cells that
  // contain it.
  template <class Descend, class Visit>
  void leaves_where(const Descend& descend, const Visit& visit) const {
    std::vector<int>& open = walk_;
    open.assign(1, 0);
    while (!open.empty()) {
      const int index = open.back();
      open.pop_back();
      const Node& cell = at(index);
      if (!descend(box_of(cell))) continue;
      if (cell.state != CellState::inner) {
        visit(index);
        continue;
      }
      for (int i = 0; i < cell.child_count(); ++i) open.push_back(cell.children + i);
    }
  }

 private:
  std::shared_ptr<TimeTree> a_;
  std::shared_ptr<TimeTree> b_;
  std::vector<Node> cells_;
  mutable std::vector<int> walk_;  // scratch
};

}  // namespace armloom
