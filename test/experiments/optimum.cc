#include "test/experiments/optimum.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <span>
#include <stdexcept>
#include <utility>

#include "core/collision/arbiter.h"
#include "test/experiments/shortest_way.h"

namespace armloom::experiments {
namespace {

constexpr std::uint64_t kBudget = 1'000'000;  // cells of one diagram: as many as it takes

// The squares of one diagram: row by row, those of A's motion are the rows.
struct Block {
  std::vector<char> in_conflict;  // all over
  std::vector<char> not_free;     // somewhere
};

// One arm's motions, laid end to end.
struct Lane {
  struct Leg {
    TrajectoryPtr motion;  // the first of those that are alike
    std::size_t squares;
    TimePoint from;
  };
  ArmId arm;
  std::vector<Leg> legs;

  [[nodiscard]] std::size_t squares() const {
    std::size_t sum = 0;
    for (const Leg& leg : legs) sum += leg.squares;
    return sum;
  }
};

bool alike(const Trajectory& a, const Trajectory& b) {
  return a.duration() == b.duration() && a.joints() == b.joints() &&
         std::ranges::equal(a.segments(), b.segments(), [](const Segment& x, const Segment& y) {
           return x.duration == y.duration && x.coefficients == y.coefficients;
         });
}

Lane lane_of(ArmId arm, const std::vector<Work>& work) {
  Lane lane{arm, {}};
  for (const Work& part : work) {
    if (part.arm != arm) continue;
    const Duration duration = part.motion->duration();
    if (duration % kCell != Duration{}) {
      throw std::invalid_argument("optimum: a duration is not a multiple of kCell");
    }
    const auto known = std::ranges::find_if(
        lane.legs, [&](const Lane::Leg& leg) { return alike(*leg.motion, *part.motion); });
    lane.legs.push_back({known == lane.legs.end() ? part.motion : known->motion,
                         static_cast<std::size_t>(duration / kCell),
                         part.from});
  }
  return lane;
}

class Squares {
 public:
  explicit Squares(const CellPtr& cell) : rest_(cell->home()), arbiter_(scene_of(cell)) {}

  [[nodiscard]] const Block& between(const Lane::Leg& a, const Lane::Leg& b) {
    const auto [found, is_new] = blocks_.try_emplace({a.motion.get(), b.motion.get()});
    if (is_new) found->second = drawn(a, b);
    return found->second;
  }

 private:
  static PlanningScenePtr scene_of(const CellPtr& cell) {
    auto scene = PlanningScene::build(cell);
    if (!scene) throw std::runtime_error(scene.error().front().detail);
    return *scene;
  }

  [[nodiscard]] Block drawn(const Lane::Leg& a, const Lane::Leg& b) {
    const Diagram diagram = arbiter_.draw(a.motion, b.motion, rest_, 0.0, kCell, kBudget);
    std::vector<std::int64_t> conflict(a.squares * b.squares);  // covered area, ns^2
    std::vector<std::int64_t> free(conflict.size());
    for (const DiagramCell& cell : diagram.layers.at(0).cells) {
      if (cell.state == DiagramCell::State::conflict) cover(cell, b.squares, conflict);
      if (cell.state == DiagramCell::State::free) cover(cell, b.squares, free);
    }
    constexpr std::int64_t kWhole = kCell.count() * kCell.count();
    Block block{std::vector<char>(conflict.size()), std::vector<char>(conflict.size())};
    for (std::size_t i = 0; i < conflict.size(); ++i) {
      block.in_conflict[i] = conflict[i] == kWhole ? 1 : 0;
      block.not_free[i] = free[i] == kWhole ? 0 : 1;
    }
    return block;
  }

  // Cells are disjoint, so areas add up.
  static void cover(const DiagramCell& cell, std::size_t columns, std::vector<std::int64_t>& area) {
    const auto first = [](Duration from) { return from / kCell; };
    const auto overlap = [](Duration from, Duration to, std::int64_t square) {
      return (std::min(to, kCell * (square + 1)) - std::max(from, kCell * square)).count();
    };
    for (std::int64_t row = first(cell.from_a); kCell * row < cell.to_a; ++row) {
      const std::int64_t height = overlap(cell.from_a, cell.to_a, row);
      for (std::int64_t column = first(cell.from_b); kCell * column < cell.to_b; ++column) {
        area[static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column)] +=
            height * overlap(cell.from_b, cell.to_b, column);
      }
    }
  }

  Configuration rest_;
  Arbiter arbiter_;
  std::map<std::pair<const Trajectory*, const Trajectory*>, Block> blocks_;
};

// Whoever is in the first square of a leg may still stand where the one before has ended: so a way
// that is to be a bound counts a leg's time from one square on.
std::size_t ready(const Lane::Leg& leg, bool bound) {
  const auto from = static_cast<std::size_t>(leg.from.time_since_epoch() / kCell);
  if (bound) return std::max<std::size_t>(from, 1) - 1;
  return at(kCell * from) < leg.from ? from + 1 : from;
}

ShortestWay way_beside(const Lane& b, bool bound) {
  std::vector<std::size_t> columns;
  for (const Lane::Leg& leg : b.legs) columns.insert(columns.end(), leg.squares, ready(leg, bound));
  return ShortestWay(std::move(columns));
}

// Whole squares of time between the first and the last: at least that long, and at most one more.
struct Steps {
  std::size_t least;
  std::size_t most;
};
Steps steps_of(const Lane& a, const Lane& b, Squares& squares) {
  ShortestWay least = way_beside(b, true);
  ShortestWay most = way_beside(b, false);
  std::vector<char> row(b.squares());
  const auto add = [&](ShortestWay& way, std::vector<char> Block::*of, const Lane::Leg& leg,
                       std::size_t i, bool bound) {
    auto to = row.begin();
    for (const Lane::Leg& other : b.legs) {
      const std::vector<char>& cells = squares.between(leg, other).*of;
      const auto from = cells.begin() + static_cast<std::ptrdiff_t>(i * other.squares);
      to = std::copy(from, from + static_cast<std::ptrdiff_t>(other.squares), to);
    }
    way.add_row(row, ready(leg, bound));
  };
  for (const Lane::Leg& leg : a.legs) {
    for (std::size_t i = 0; i < leg.squares; ++i) {
      add(least, &Block::in_conflict, leg, i, true);
      add(most, &Block::not_free, leg, i, false);
    }
  }
  if (!least.steps() || !most.steps()) throw std::runtime_error("optimum: there is no way");
  return {*least.steps(), *most.steps() + 1};
}

}  // namespace

Optimum optimum(const CellPtr& cell, const std::vector<Work>& work) {
  Squares squares(cell);
  std::vector<Lane> lanes;
  for (std::uint32_t i = 0; i < cell->arms.size(); ++i) lanes.push_back(lane_of(ArmId(i), work));
  Optimum found;
  for (std::size_t a = 0; a < lanes.size(); ++a) {
    for (std::size_t b = a + 1; b < lanes.size(); ++b) {
      if (lanes[a].legs.empty() || lanes[b].legs.empty()) continue;
      const Steps steps = steps_of(lanes[a], lanes[b], squares);
      const double square_s = to_seconds(kCell);
      const double least_s = square_s * static_cast<double>(steps.least);
      found.most_s = std::max(found.most_s, square_s * static_cast<double>(steps.most));
      if (least_s <= found.least_s) continue;
      found.least_s = least_s;
      found.arms = {cell->arms[a].name, cell->arms[b].name};
    }
  }
  return found;
}

}  // namespace armloom::experiments
