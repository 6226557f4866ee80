#include "test/experiments/optimum.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "test/experiments/shortest_way.h"

namespace armloom::experiments {
namespace {

constexpr Duration kSquare = JoinedDiagram::kSquare;

// Returns the first square in which a leg may begin. For a lower bound this is one square earlier,
// because there the arm may still be at the end of the previous leg.
std::size_t ready(const Lane::Leg& leg, bool bound) {
  const auto from = static_cast<std::size_t>(leg.from.time_since_epoch() / kSquare);
  if (bound) return std::max<std::size_t>(from, 1) - 1;
  return at(kSquare * from) < leg.from ? from + 1 : from;
}

ShortestWay way_beside(const Lane& b, bool bound) {
  std::vector<std::size_t> columns;
  for (const Lane::Leg& leg : b.legs) columns.insert(columns.end(), leg.squares, ready(leg, bound));
  return ShortestWay(std::move(columns));
}

// A path through n squares takes at least n - 1 squares of time (from inside to inside), and at
// most n (from corner to corner).
struct Squares {
  std::size_t least;
  std::size_t most;
};
Squares squares_of(const Lane& a, const Lane& b, JoinedDiagram& diagram) {
  ShortestWay least = way_beside(b, true);
  ShortestWay most = way_beside(b, false);
  JoinedDiagram::Row row;
  for (const Lane::Leg& leg : a.legs) {
    for (std::size_t i = 0; i < leg.squares; ++i) {
      diagram.read(leg, i, b, row);
      least.add_row(row.in_conflict, ready(leg, true));
      most.add_row(row.not_free, ready(leg, false));
    }
  }
  if (!least.steps() || !most.steps()) throw std::runtime_error("optimum: there is no way");
  return {*least.steps(), *most.steps() + 1};
}

}  // namespace

Optimum optimum(const CellPtr& cell, const std::vector<Work>& work) {
  JoinedDiagram diagram(cell);
  std::vector<Lane> lanes;
  for (std::uint32_t i = 0; i < cell->arms.size(); ++i) {
    lanes.push_back(JoinedDiagram::lane_of(ArmId(i), work));
  }
  Optimum found;
  for (std::size_t a = 0; a < lanes.size(); ++a) {
    for (std::size_t b = a + 1; b < lanes.size(); ++b) {
      if (lanes[a].legs.empty() || lanes[b].legs.empty()) continue;
      const Squares squares = squares_of(lanes[a], lanes[b], diagram);
      const double least_s = to_seconds(kSquare) * static_cast<double>(squares.least);
      const double most_s = to_seconds(kSquare) * static_cast<double>(squares.most);
      found.most_s = std::max(found.most_s, most_s);
      if (least_s <= found.least_s) continue;
      found.least_s = least_s;
      found.arms = {cell->arms[a].name, cell->arms[b].name};
    }
  }
  return found;
}

}  // namespace armloom::experiments
