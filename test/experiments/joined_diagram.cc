#include "test/experiments/joined_diagram.h"

#include <algorithm>
#include <stdexcept>

namespace armloom::experiments {
namespace {

constexpr std::uint64_t kBudget = 1'000'000;  // cells of one diagram: as many as it takes
constexpr Duration kSquare = JoinedDiagram::kSquare;

bool alike(const Trajectory& a, const Trajectory& b) {
  return a.duration() == b.duration() && a.joints() == b.joints() &&
         std::ranges::equal(a.segments(), b.segments(), [](const Segment& x, const Segment& y) {
           return x.duration == y.duration && x.coefficients == y.coefficients;
         });
}

PlanningScenePtr scene_of(const CellPtr& cell) {
  auto scene = PlanningScene::build(cell);
  if (!scene) throw std::runtime_error(scene.error().front().detail);
  return *scene;
}

// Adds to each square the area (ns^2) that the cell covers of it. Precondition: cells do not
// overlap.
void cover(const DiagramCell& cell, std::size_t columns, std::vector<std::int64_t>& area) {
  const auto overlap = [](Duration from, Duration to, std::int64_t square) {
    return (std::min(to, kSquare * (square + 1)) - std::max(from, kSquare * square)).count();
  };
  for (std::int64_t row = cell.from_a / kSquare; kSquare * row < cell.to_a; ++row) {
    const std::int64_t height = overlap(cell.from_a, cell.to_a, row);
    for (std::int64_t column = cell.from_b / kSquare; kSquare * column < cell.to_b; ++column) {
      area[static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column)] +=
          height * overlap(cell.from_b, cell.to_b, column);
    }
  }
}

}  // namespace

std::size_t Lane::squares() const {
  std::size_t sum = 0;
  for (const Leg& leg : legs) sum += leg.squares;
  return sum;
}

JoinedDiagram::JoinedDiagram(const CellPtr& cell) : rest_(cell->home()), checker_(scene_of(cell)) {}

Lane JoinedDiagram::lane_of(ArmId arm, const std::vector<Work>& work) {
  Lane lane{arm, {}};
  for (const Work& part : work) {
    if (part.arm != arm) continue;
    const Duration duration = part.motion->duration();
    if (duration % kSquare != Duration{}) {
      throw std::invalid_argument("JoinedDiagram: a duration is no multiple of kSquare");
    }
    const auto known = std::ranges::find_if(
        lane.legs, [&](const Lane::Leg& leg) { return alike(*leg.motion, *part.motion); });
    lane.legs.push_back({known == lane.legs.end() ? part.motion : known->motion,
                         static_cast<std::size_t>(duration / kSquare), part.from});
  }
  return lane;
}

void JoinedDiagram::read(const Lane::Leg& leg, std::size_t square, const Lane& columns, Row& row) {
  row.in_conflict.clear();
  row.not_free.clear();
  for (const Lane::Leg& other : columns.legs) {
    const Row& block = between(leg, other);
    const auto append = [&](const std::vector<char>& from, std::vector<char>& to) {
      const auto first = from.begin() + static_cast<std::ptrdiff_t>(square * other.squares);
      to.insert(to.end(), first, first + static_cast<std::ptrdiff_t>(other.squares));
    };
    append(block.in_conflict, row.in_conflict);
    append(block.not_free, row.not_free);
  }
}

const JoinedDiagram::Row& JoinedDiagram::between(const Lane::Leg& a, const Lane::Leg& b) {
  const auto [found, is_new] = blocks_.try_emplace({a.motion.get(), b.motion.get()});
  if (is_new) found->second = drawn(a, b);
  return found->second;
}

JoinedDiagram::Row JoinedDiagram::drawn(const Lane::Leg& a, const Lane::Leg& b) {
  const Diagram diagram = checker_.draw({a.motion, b.motion, rest_, 0.0, kSquare, kBudget});
  std::vector<std::int64_t> conflict(a.squares * b.squares);
  std::vector<std::int64_t> free(conflict.size());
  for (const DiagramCell& cell : diagram.layers.at(0).cells) {
    if (cell.state == DiagramCell::State::conflict) cover(cell, b.squares, conflict);
    if (cell.state == DiagramCell::State::free) cover(cell, b.squares, free);
  }
  constexpr std::int64_t kWhole = kSquare.count() * kSquare.count();
  Row block{std::vector<char>(conflict.size()), std::vector<char>(conflict.size())};
  for (std::size_t i = 0; i < conflict.size(); ++i) {
    block.in_conflict[i] = conflict[i] == kWhole ? 1 : 0;
    block.not_free[i] = free[i] == kWhole ? 0 : 1;
  }
  return block;
}

}  // namespace armloom::experiments
