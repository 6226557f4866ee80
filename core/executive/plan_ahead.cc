#include "core/executive/plan_ahead.h"

#include <algorithm>
#include <array>

namespace armloom {
namespace {

struct DiagramPlace {
  double a_s, b_s;
};

// Returns the share (0..1) of the segment at which it enters the closed rectangle; nullopt if it
// misses it.
std::optional<double> entry(const DiagramPlace& from, const DiagramPlace& to,
                            const DiagramCell& cell) {
  double enters = 0.0;
  double leaves = 1.0;
  const auto clip = [&](double start, double end, Duration low, Duration high) {
    const double span = end - start;
    if (span <= 0.0) return to_seconds(low) <= start && start <= to_seconds(high);
    enters = std::max(enters, (to_seconds(low) - start) / span);
    leaves = std::min(leaves, (to_seconds(high) - start) / span);
    return true;
  };
  if (!clip(from.a_s, to.a_s, cell.from_a, cell.to_a)) return std::nullopt;
  if (!clip(from.b_s, to.b_s, cell.from_b, cell.to_b)) return std::nullopt;
  return enters < leaves ? std::optional(enters) : std::nullopt;
}

std::optional<DiagramContact> first_of(DiagramCell::State state,
                                       const std::vector<DiagramCell>& cells,
                                       const std::array<DiagramPlace, 3>& way) {
  double passed_s = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) {
    const DiagramPlace& from = way[i - 1];
    const DiagramPlace& to = way[i];
    std::optional<double> first;
    for (const DiagramCell& cell : cells) {
      if (cell.state != state) continue;
      const auto enters = entry(from, to, cell);
      if (enters && (!first || *enters < *first)) first = enters;
    }
    const double length_s = std::max(to.a_s - from.a_s, to.b_s - from.b_s);
    if (first) {
      return DiagramContact{state, from_seconds(passed_s + *first * length_s),
                            from_seconds(from.a_s + *first * (to.a_s - from.a_s)),
                            from_seconds(from.b_s + *first * (to.b_s - from.b_s))};
    }
    passed_s += length_s;
  }
  return std::nullopt;
}

}  // namespace

std::optional<DiagramContact> first_met(const std::vector<DiagramCell>& cells, Duration at_a,
                                        Duration at_b, Duration end_a, Duration end_b) {
  const Duration together = std::min(end_a - at_a, end_b - at_b);
  const std::array<DiagramPlace, 3> way{{{to_seconds(at_a), to_seconds(at_b)},
                                         {to_seconds(at_a + together), to_seconds(at_b + together)},
                                         {to_seconds(end_a), to_seconds(end_b)}}};
  const auto conflict = first_of(DiagramCell::State::conflict, cells, way);
  return conflict ? conflict : first_of(DiagramCell::State::undecided, cells, way);
}

}  // namespace armloom
