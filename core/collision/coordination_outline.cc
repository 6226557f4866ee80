// Where the free and the other cells of a diagram meet.
#include <algorithm>
#include <utility>

#include "core/collision/coordination_diagram_impl.h"

namespace armloom {

bool CoordinationDiagram::remains(const Cell& cell, Duration now_a, Duration now_b) const {
  return a_->to(cell.a) >= now_a && b_->to(cell.b) >= now_b;
}

// Calls visit(leaf) for what touches the cell, corners included, until it says yes: whether it did.
template <class Visit>
bool CoordinationDiagram::leaves_at(const Cell& of, const Visit& visit) const {
  std::vector<int>& open = setting_.scratch->open;
  open.assign(1, 0);
  while (!open.empty()) {
    const int index = open.back();
    open.pop_back();
    const Cell& cell = cells_[static_cast<std::size_t>(index)];
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

bool CoordinationDiagram::borders_on_free(const Cell& cell) const {
  return leaves_at(cell, [this](int other) {
    return cells_[static_cast<std::size_t>(other)].state == CellState::free;
  });
}

std::uint64_t CoordinationDiagram::refine_outline(Duration now_a, Duration now_b,
                                                  const Resolution& resolution,
                                                  std::uint64_t budget) {
  if (outlined_ && outlined_->now_a <= now_a && outlined_->now_b <= now_b &&
      outlined_->resolution.coarse <= resolution.coarse &&
      outlined_->resolution.fine <= resolution.fine) {
    return 0;
  }
  constexpr double kAll = Region::kUnbounded;
  const Region region{.progress_a = to_seconds(now_a),
                      .progress_b = to_seconds(now_b),
                      .lag_a = kAll,
                      .lag_b = kAll,
                      .lead_a = kAll,
                      .lead_b = kAll,
                      .duration_a = to_seconds(a_->duration()),
                      .duration_b = to_seconds(b_->duration())};
  std::uint64_t looked_at = refine(region, kWide, budget);
  // A motion that is still to come finds the other one anywhere on its way: hence the edges.
  const auto may_be_entered = [&](const Cell& cell) {
    return a_->from(cell.a) <= now_a || b_->from(cell.b) <= now_b || borders_on_free(cell);
  };
  const auto is_open = [&](int index) {
    const CellState state = at(index).state;
    return (state == CellState::mixed || state == CellState::unknown) &&
           remains(at(index), now_a, now_b);
  };
  std::vector<int> border;  // leaves that may be entered from what is free
  for (int i = 0; i < static_cast<int>(cells_.size()); ++i) {
    if (is_open(i) && may_be_entered(at(i))) border.push_back(i);
  }
  std::vector<Open> unknown;
  while (!border.empty() && looked_at < budget) {
    std::ranges::sort(border);
    border.erase(std::ranges::unique(border).begin(), border.end());
    unknown.clear();
    for (const int index : std::exchange(border, {})) {
      if (at(index).state == CellState::unknown) unknown.push_back({index, {0.0, 0.0}});
      split_if_coarse(index, proven(at(index)) != nullptr ? resolution.coarse : resolution.fine);
      const Cell cell = at(index);
      if (cell.state != CellState::inner) continue;
      for (int child = cell.children; child < cell.children + cell.child_count(); ++child) {
        if (remains(at(child), now_a, now_b) && may_be_entered(at(child))) {
          unknown.push_back({child, {0.0, 0.0}});
        }
      }
    }
    looked_at += evaluate_all(unknown, budget - looked_at);
    for (const Open& leaf : unknown) {
      if (at(leaf.cell).state == CellState::mixed) border.push_back(leaf.cell);
      if (at(leaf.cell).state != CellState::free) continue;
      leaves_at(at(leaf.cell), [&](int other) {
        if (is_open(other)) border.push_back(other);
        return false;
      });
    }
  }
  if (looked_at < budget) outlined_ = {now_a, now_b, resolution};
  return looked_at;
}

std::vector<CoordinationDiagram::Blocked> CoordinationDiagram::blocked(Duration now_a,
                                                                       Duration now_b) const {
  std::vector<Blocked> blocked;
  for (const Cell& cell : cells_) {
    if (cell.state == CellState::inner || cell.state == CellState::free) continue;
    if (!remains(cell, now_a, now_b)) continue;
    Blocked& leaf = blocked.emplace_back();
    leaf.from_a = a_->from(cell.a);
    leaf.to_a = a_->to(cell.a);
    leaf.from_b = b_ ? b_->from(cell.b) : Duration{};
    leaf.to_b = b_ ? b_->to(cell.b) : Duration{};
    if (cell.finding < 0) continue;
    const Found& found = found_[static_cast<std::size_t>(cell.finding)];
    const Duration time_b = b_ ? b_->middle(cell.b) : Duration{};
    leaf.found = {found.pair, found.distance_m, a_->middle(cell.a), time_b, 0.0};
    leaf.proven = proven(cell) != nullptr;
  }
  return blocked;
}

std::uint64_t CoordinationDiagram::look_closer(const std::vector<Area>& areas, Duration finest,
                                               std::uint64_t budget) {
  const auto meant = [&](const Cell& cell) {
    const Duration a = a_->middle(cell.a);
    const Duration b = b_ ? b_->middle(cell.b) : Duration{};
    return std::ranges::any_of(areas, [&](const Area& area) {
      return area.from_a <= a && a <= area.to_a && area.from_b <= b && b <= area.to_b;
    });
  };
  const auto open = [&](const Cell& cell) {
    return cell.state == CellState::mixed && wider(cell, finest);
  };
  std::vector<int> cells;
  std::vector<Open> unknown;
  for (int i = 0; i < static_cast<int>(cells_.size()); ++i) {
    if (at(i).state == CellState::unknown && meant(at(i))) unknown.push_back({i, {0.0, 0.0}});
    if (open(at(i)) && meant(at(i))) cells.push_back(i);
  }
  std::uint64_t looked_at = 0;
  while (!cells.empty() || !unknown.empty()) {
    for (const int index : cells) {
      split_if_coarse(index, finest);
      const Cell cell = at(index);
      for (int c = 0; c < cell.child_count(); ++c) {
        unknown.push_back({cell.children + c, {0.0, 0.0}});
      }
    }
    cells.clear();
    looked_at += evaluate_all(unknown, budget - looked_at);
    if (looked_at >= budget) return looked_at;
    for (const Open& leaf : std::exchange(unknown, {})) {
      const Cell& cell = at(leaf.cell);
      if (cell.state == CellState::conflict || proven(cell) != nullptr) return looked_at;
      if (open(cell)) cells.push_back(leaf.cell);
    }
  }
  return looked_at;
}

}  // namespace armloom
