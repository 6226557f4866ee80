// Where the free and the other cells of a diagram meet.
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/collision/coordination_diagram_impl.h"

namespace armloom {

// Which parts of the diagram are known to be free, in squares of one width on each axis, with a
// frame of squares around it that are not.
class CoordinationDiagram::Raster {
 public:
  // Squares are those of a tree that is halved until they are no wider than `resolution`.
  Raster(const MotionTube& a, const MotionTube& b, Duration resolution)
      : a_(a), b_(b), squares_a_(count(a, resolution)), squares_b_(count(b, resolution)) {
    free_.resize((squares_a_ + 2) * (squares_b_ + 2), 0);
  }

  void mark_free(const Cell& cell) {
    const Span a = span(a_, cell.a, squares_a_);
    const Span b = span(b_, cell.b, squares_b_);
    for (std::size_t i = a.from; i < a.to; ++i) {
      std::fill(square(i + 1, b.from + 1), square(i + 1, b.to + 1), std::uint8_t{1});
    }
  }

  // Whether any square around the cell is free, corners included.
  [[nodiscard]] bool borders_on_free(const Cell& cell) {
    const Span a = span(a_, cell.a, squares_a_);
    const Span b = span(b_, cell.b, squares_b_);
    const auto any = [](const std::uint8_t* from, const std::uint8_t* to) {
      return std::find(from, to, std::uint8_t{1}) != to;
    };
    if (any(square(a.from, b.from), square(a.from, b.to + 2))) return true;
    if (any(square(a.to + 1, b.from), square(a.to + 1, b.to + 2))) return true;
    for (std::size_t i = a.from + 1; i <= a.to; ++i) {
      if (*square(i, b.from) != 0 || *square(i, b.to + 1) != 0) return true;
    }
    return false;
  }

 private:
  struct Span {
    std::size_t from, to;
  };
  [[nodiscard]] static std::size_t count(const MotionTube& tube, Duration resolution) {
    std::size_t squares = 1;
    for (Duration width = tube.duration(); width > resolution; width /= 2) squares *= 2;
    return squares;
  }
  // Of a node narrower than a square: none, or one.
  [[nodiscard]] static Span span(const MotionTube& tube, int node, std::size_t squares) {
    if (tube.duration() == Duration{}) return {0, squares};
    const double per_second = static_cast<double>(squares) / to_seconds(tube.duration());
    const auto place = [&](Duration at) {
      return static_cast<std::size_t>(std::llround(to_seconds(at) * per_second));
    };
    return {place(tube.from(node)), place(tube.to(node))};
  }
  [[nodiscard]] std::uint8_t* square(std::size_t i, std::size_t j) {
    return free_.data() + i * (squares_b_ + 2) + j;
  }

  const MotionTube& a_;
  const MotionTube& b_;
  std::size_t squares_a_, squares_b_;
  std::vector<std::uint8_t> free_;
};

bool CoordinationDiagram::remains(const Cell& cell, Duration now_a, Duration now_b) const {
  return a_->to(cell.a) >= now_a && b_->to(cell.b) >= now_b;
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
  std::uint64_t looked_at = refine(region, resolution.coarse, budget);
  std::vector<int> coarse, later;
  const auto consider = [&](int index) {
    const Cell& cell = at(index);
    const bool open = cell.state == CellState::mixed && proven(cell) == nullptr;
    if (open && wider(cell, resolution.fine)) coarse.push_back(index);
  };
  for (int i = 0; i < static_cast<int>(cells_.size()); ++i) {
    if (at(i).state == CellState::mixed && remains(at(i), now_a, now_b)) consider(i);
  }
  Raster raster(*a_, *b_, resolution.fine);
  for (const Cell& cell : cells_) {
    if (cell.state == CellState::free && remains(cell, now_a, now_b)) raster.mark_free(cell);
  }
  std::vector<Open> unknown;
  while (looked_at < budget) {
    unknown.clear();
    later.clear();
    for (const int index : coarse) {
      if (!raster.borders_on_free(at(index))) {
        later.push_back(index);
        continue;
      }
      split_if_coarse(index, resolution.fine);
      const Cell cell = at(index);
      for (int c = 0; c < cell.child_count(); ++c) {
        if (remains(at(cell.children + c), now_a, now_b))
          unknown.push_back({cell.children + c, {0.0, 0.0}});
      }
    }
    if (unknown.empty()) break;
    std::swap(coarse, later);
    for (std::size_t done = 0; done < unknown.size() && looked_at < budget;
         done += filter::kLanes) {
      const std::size_t count = std::min<std::size_t>(filter::kLanes, unknown.size() - done);
      evaluate(unknown.data() + done, count);
      looked_at += count;
    }
    for (const Open& open : unknown) {
      if (at(open.cell).state == CellState::free) raster.mark_free(at(open.cell));
      consider(open.cell);
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
    for (std::size_t done = 0; done < unknown.size(); done += filter::kLanes) {
      if (looked_at >= budget) return looked_at;
      const std::size_t count = std::min<std::size_t>(filter::kLanes, unknown.size() - done);
      evaluate(unknown.data() + done, count);
      looked_at += count;
    }
    for (const Open& leaf : std::exchange(unknown, {})) {
      const Cell& cell = at(leaf.cell);
      if (cell.state == CellState::conflict || proven(cell) != nullptr) return looked_at;
      if (open(cell)) cells.push_back(leaf.cell);
    }
  }
  return looked_at;
}

}  // namespace armloom
