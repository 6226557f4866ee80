#include "core/collision/check/joined_cells.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace armloom {
namespace {

// Whether both together are one rectangle of one state.
bool joins(const DiagramCell& x, const DiagramCell& y) {
  const bool same_a = x.from_a == y.from_a && x.to_a == y.to_a;
  const bool same_b = x.from_b == y.from_b && x.to_b == y.to_b;
  return x.state == y.state && ((same_a && (x.to_b == y.from_b || y.to_b == x.from_b)) ||
                                (same_b && (x.to_a == y.from_a || y.to_a == x.from_a)));
}

// Place on the curve that visits a rectangle quarter by quarter (Morton 1966): cells that a tree of
// quarters has split apart come one after the other.
std::uint64_t place_of(const DiagramCell& cell, const Diagram& diagram) {
  const auto share = [](Duration from, Duration whole) {
    return static_cast<std::uint64_t>(std::llround(to_seconds(from) / to_seconds(whole) * 65536.0));
  };
  const std::uint64_t a = share(cell.from_a, diagram.duration_a);
  const std::uint64_t b = share(cell.from_b, diagram.duration_b);
  std::uint64_t place = 0;
  for (unsigned bit = 0; bit < 17; ++bit) {
    place |= (((a >> bit) & 1U) << (2 * bit + 1)) | (((b >> bit) & 1U) << (2 * bit));
  }
  return place;
}

}  // namespace

std::vector<DiagramCell> joined(std::vector<DiagramCell> cells, const Diagram& diagram) {
  std::ranges::sort(cells, {}, [&](const DiagramCell& cell) { return place_of(cell, diagram); });
  std::vector<DiagramCell> result;
  for (DiagramCell cell : cells) {
    while (!result.empty() && joins(result.back(), cell)) {
      const DiagramCell& last = result.back();
      cell = {std::min(last.from_a, cell.from_a), std::max(last.to_a, cell.to_a),
              std::min(last.from_b, cell.from_b), std::max(last.to_b, cell.to_b), cell.state};
      result.pop_back();
    }
    result.push_back(cell);
  }
  return result;
}

}  // namespace armloom
