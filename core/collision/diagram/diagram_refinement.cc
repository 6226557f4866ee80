#include <algorithm>
#include <utility>

#include "core/collision/diagram/box_areas.h"
#include "core/collision/diagram/coordination_diagram.h"
#include "core/collision/diagram/passing_edges.h"

namespace armloom {
namespace {

bool is_refinable(const CellTree::Node& cell) {
  return cell.state == CellTree::CellState::mixed || cell.state == CellTree::CellState::unknown;
}

}  // namespace

// Refines `leaves` within the budget; returns the number of evaluated cells. expand(leaves,
// unknown) splits leaves as required and lists the cells to evaluate in `unknown`. After their
// evaluation, follow(unknown) returns the leaves to refine next.
template <class Expand, class Follow>
std::uint64_t CoordinationDiagram::refine_from(std::vector<int> leaves, std::uint64_t budget,
                                               const Expand& expand, const Follow& follow) {
  std::uint64_t looked_at = 0;
  std::vector<int> unknown;
  std::vector<TubePair::Nodes> nodes;
  while (!leaves.empty()) {
    unknown.clear();
    expand(leaves, unknown);
    nodes.clear();
    for (const int cell : unknown) nodes.push_back(nodes_of(tree_.at(cell)));
    pair_.place_all(nodes);
    for (std::span<const int> left = unknown; !left.empty();) {
      if (looked_at >= budget) return looked_at;
      const auto batch = left.first(std::min<std::size_t>(filter::kLanes, left.size()));
      evaluate(batch);
      looked_at += batch.size();
      if (!pair_.goes_on(batch.size())) return std::max(looked_at, budget);
      left = left.subspan(batch.size());
    }
    if (looked_at >= budget) return looked_at;
    leaves = follow(unknown);
  }
  return looked_at;
}

std::uint64_t CoordinationDiagram::refine(Duration now_a, Duration now_b, Duration resolution,
                                          std::uint64_t budget) {
  const auto expand = [&](std::vector<int>& open, std::vector<int>& unknown) {
    for (std::size_t i = 0; i < open.size(); ++i) {  // `open` grows
      const int index = open[i];
      if (!tree_.remains(tree_.at(index), now_a, now_b)) continue;
      tree_.split_if_wide(index, std::max(CellTree::kWide, resolution));
      if (tree_.at(index).state == CellState::unknown) unknown.push_back(index);
      tree_.split_if_coarse(index, resolution);
      const Node now = tree_.at(index);
      if (now.state != CellState::inner) continue;
      for (int c = 0; c < now.child_count(); ++c) open.push_back(now.children + c);
    }
  };
  return refine_from({0}, budget, expand, [](const std::vector<int>& seen) { return seen; });
}

std::uint64_t CoordinationDiagram::refine_outline(Duration now_a, Duration now_b,
                                                  const Resolution& resolution,
                                                  std::uint64_t budget) {
  if (is_outlined(now_a, now_b, resolution)) return 0;
  begin_anew_if_passed(now_a, now_b);
  if (tree_.size() >= kFull) return 0;
  std::uint64_t looked_at = 0;
  Duration width = first_width(now_a, now_b, budget);
  for (; width >= CellTree::kWide && looked_at < budget; width /= 2) {
    looked_at += refine(now_a, now_b, width, budget - looked_at);
  }
  // When a motion that is to come starts, the other motion may be anywhere on its path. So motions
  // may also enter cells through the edges of the diagram.
  const auto may_be_entered = [&](const Node& cell) {
    return tree_.a().from(cell.a) <= now_a || tree_.b().from(cell.b) <= now_b ||
           tree_.leaves_at(cell,
                           [&](int other) { return tree_.at(other).state == CellState::free; });
  };
  const auto may_be_finer = [&](int index) {
    return is_refinable(tree_.at(index)) && tree_.remains(tree_.at(index), now_a, now_b);
  };
  std::vector<int> border;  // leaves next to free cells or edges
  for (int i = 0; i < tree_.size(); ++i) {
    if (may_be_finer(i) && may_be_entered(tree_.at(i))) border.push_back(i);
  }
  const auto expand = [&](std::vector<int>& leaves, std::vector<int>& unknown) {
    std::ranges::sort(leaves);
    leaves.erase(std::ranges::unique(leaves).begin(), leaves.end());
    for (const int index : leaves) {
      if (tree_.at(index).state == CellState::unknown) unknown.push_back(index);
      tree_.split_if_coarse(
          index, proven(tree_.at(index)) != nullptr ? resolution.coarse : resolution.fine);
      const Node cell = tree_.at(index);
      if (cell.state != CellState::inner) continue;
      for (int child = cell.children; child < cell.children + cell.child_count(); ++child) {
        if (tree_.remains(tree_.at(child), now_a, now_b) && may_be_entered(tree_.at(child)))
          unknown.push_back(child);
      }
    }
  };
  const auto follow = [&](const std::vector<int>& seen) {
    std::vector<int> next;
    for (const int leaf : seen) {
      if (tree_.at(leaf).state == CellState::mixed) next.push_back(leaf);
      if (tree_.at(leaf).state != CellState::free) continue;
      tree_.leaves_at(tree_.at(leaf), [&](int other) {
        if (may_be_finer(other)) next.push_back(other);
        return false;
      });
    }
    return next;
  };
  if (looked_at < budget) {
    looked_at += refine_from(std::move(border), budget - looked_at, expand, follow);
  }
  if (looked_at < budget) {
    looked_at += refine_passing_edges(now_a, now_b, resolution.passing, budget - looked_at);
  }
  if (looked_at < budget) outlined_ = {now_a, now_b, resolution};
  return looked_at;
}

double CoordinationDiagram::area_s2(Duration now_a, Duration now_b) const {
  return to_seconds(tree_.a().duration() - now_a) * to_seconds(tree_.b().duration() - now_b);
}

// Returns kWide, doubled until the first cells need at most kFirstShare of the budget.
Duration CoordinationDiagram::first_width(Duration now_a, Duration now_b,
                                          std::uint64_t budget) const {
  const double cells_max = kFirstShare * static_cast<double>(budget);
  const double area = area_s2(now_a, now_b);
  Duration width = CellTree::kWide;
  // Halving may make cells half as wide as required, and so four times as many.
  while (4.0 * area > cells_max * to_seconds(width) * to_seconds(width)) width *= 2;
  return width;
}

void CoordinationDiagram::begin_anew_if_passed(Duration now_a, Duration now_b) {
  const double area = area_s2(now_a, now_b);
  if (tree_.size() >= kFull && area < 0.5 * begun_with_s2_) {
    tree_ = CellTree(pair_.a(), pair_.is_self() ? std::make_shared<TimeTree>() : pair_.b());
    found_.clear();
    outlined_.reset();
  }
  if (tree_.size() == 1) begun_with_s2_ = area;
}

// Returns true if an earlier refinement is still valid at the current progress of both motions and
// at least as fine as requested.
bool CoordinationDiagram::is_outlined(Duration now_a, Duration now_b,
                                      const Resolution& resolution) const {
  if (!outlined_ || outlined_->now_a > now_a || outlined_->now_b > now_b) return false;
  const Resolution& before = outlined_->resolution;
  if (before.coarse > resolution.coarse || before.fine > resolution.fine) return false;
  if (before.passing.fine > resolution.passing.fine) return false;
  const auto blurs = [&](const Node& cell) {
    return is_refinable(cell) && tree_.remains(cell, now_a, now_b) &&
           tree_.a().from(cell.a) <= now_a && tree_.b().from(cell.b) <= now_b &&
           tree_.wider(cell, resolution.passing.fine);
  };
  return std::none_of(tree_.begin(), tree_.end(), blurs);
}

bool CoordinationDiagram::is_open(const Node& cell, Duration now_a, Duration now_b) const {
  return cell.state != CellState::inner && cell.state != CellState::free &&
         tree_.remains(cell, now_a, now_b);
}

OpenLeaf CoordinationDiagram::open_leaf(int index) const {
  const Node& cell = tree_.at(index);
  return {index, tree_.box_of(cell), is_refinable(cell), proven(cell) != nullptr};
}

// Splits a leaf where motions pass a region. Evaluates only the children that affect where a motion
// passes: the child at the corner, and its neighbors. If the leaf's middle is in conflict, the
// neighbors are left out, because they touch it and cannot be free.
void CoordinationDiagram::split_passing_edge(const CoarseLeaf& leaf, std::vector<int>& unknown) {
  const bool middle_is_open = proven(tree_.at(leaf.cell)) == nullptr;
  tree_.split_if_coarse(leaf.cell, leaf.allowed);
  const Node cell = tree_.at(leaf.cell);
  if (cell.state != CellState::inner) return;
  // Children are sorted along A, then along B. At the corner (to_a, from_b), A passes first.
  const int a_first = cell.split_a ? (cell.split_b ? 2 : 1) : 0;
  const int b_first = cell.split_b ? 1 : 0;
  for (int child = 0; child < cell.child_count(); ++child) {
    const bool wanted = (leaf.a_first && child == a_first) || (leaf.b_first && child == b_first) ||
                        (middle_is_open && child != a_first && child != b_first);
    if (wanted) unknown.push_back(cell.children + child);
  }
}

std::uint64_t CoordinationDiagram::refine_passing_edges(Duration now_a, Duration now_b,
                                                        const PassingResolution& resolution,
                                                        std::uint64_t budget) {
  const ProgressBox remaining{now_a, tree_.a().duration(), now_b, tree_.b().duration()};
  bool ended = false;
  std::vector<int> open;  // a cell that is not open never becomes open again
  int seen = 0;
  const auto expand = [&](const std::vector<int>&, std::vector<int>& unknown) {
    for (; seen < tree_.size(); ++seen) open.push_back(seen);
    std::erase_if(open, [&](int cell) { return !is_open(tree_.at(cell), now_a, now_b); });
    std::vector<OpenLeaf> leaves;
    for (const int cell : open) leaves.push_back(open_leaf(cell));
    const auto coarse = coarse_leaves(std::move(leaves), remaining, resolution);
    ended = coarse.empty();
    for (const CoarseLeaf& leaf : coarse) {
      if (tree_.at(leaf.cell).state == CellState::unknown) {
        unknown.push_back(leaf.cell);
      } else {
        split_passing_edge(leaf, unknown);
      }
    }
    std::erase_if(unknown, [&](int leaf) { return !tree_.remains(tree_.at(leaf), now_a, now_b); });
  };
  const auto follow = [&](const std::vector<int>&) { return std::vector<int>(ended ? 0 : 1); };
  return refine_from({0}, budget, expand, follow);
}

std::vector<CoordinationDiagram::Blocked> CoordinationDiagram::blocked(Duration now_a,
                                                                       Duration now_b) const {
  std::vector<Blocked> blocked;
  for (const Node& cell : tree_) {
    if (cell.state == CellState::inner || cell.state == CellState::free) continue;
    if (!tree_.remains(cell, now_a, now_b)) continue;
    Blocked& leaf = blocked.emplace_back(Blocked{.box = tree_.box_of(cell), .found = {}});
    if (cell.witness < 0) continue;
    const NarrowWitness& found = found_[static_cast<std::size_t>(cell.witness)];
    leaf.found = witness_at(cell, found.pair, found.distance_m);
    leaf.proven = proven(cell) != nullptr;
  }
  return blocked;
}

std::uint64_t CoordinationDiagram::refine_close_passes(const std::vector<ProgressBox>& areas,
                                                       Duration finest, std::uint64_t budget) {
  if (tree_.size() >= kFull || areas.empty()) return 0;
  const BoxAreas held(areas);
  const auto open = [&](const Node& cell) {
    return cell.state == CellState::mixed && tree_.wider(cell, finest);
  };
  std::vector<int> leaves;
  tree_.leaves_where([&](const ProgressBox& box) { return held.may_hold(box); },
                     [&](int leaf) {
                       const Node& cell = tree_.at(leaf);
                       if (cell.state != CellState::unknown && !open(cell)) return;
                       if (held.hold(tree_.a().middle(cell.a), tree_.b().middle(cell.b)))
                         leaves.push_back(leaf);
                     });
  std::ranges::sort(leaves);
  const auto expand = [&](std::vector<int>& wide, std::vector<int>& unknown) {
    for (const int index : wide) {
      if (tree_.at(index).state == CellState::unknown) unknown.push_back(index);
    }
    for (const int index : wide) {
      if (tree_.at(index).state == CellState::unknown) continue;
      tree_.split_if_coarse(index, finest);
      const Node cell = tree_.at(index);
      for (int c = 0; c < cell.child_count(); ++c) unknown.push_back(cell.children + c);
    }
  };
  const auto follow = [&](const std::vector<int>& seen) {
    std::vector<int> next;
    for (const int leaf : seen) {
      const Node& cell = tree_.at(leaf);
      if (cell.state == CellState::conflict || proven(cell) != nullptr) return std::vector<int>{};
      if (open(cell)) next.push_back(leaf);
    }
    return next;
  };
  return refine_from(std::move(leaves), budget, expand, follow);
}

}  // namespace armloom
