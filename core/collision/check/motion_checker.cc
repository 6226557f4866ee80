#include "core/collision/check/motion_checker.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/collision/check/certified_check.h"
#include "core/collision/check/timed_discrete_check.h"

namespace armloom {
namespace {

// Returns true if both cells have the same state and together form a rectangle.
bool joins(const DiagramCell& x, const DiagramCell& y) {
  const bool same_a = x.from_a == y.from_a && x.to_a == y.to_a;
  const bool same_b = x.from_b == y.from_b && x.to_b == y.to_b;
  return x.state == y.state && ((same_a && (x.to_b == y.from_b || y.to_b == x.from_b)) ||
                                (same_b && (x.to_a == y.from_a || y.to_a == x.from_a)));
}

// Returns the cell's index on the Z-order curve (Morton 1966). Neighbors from a quadtree are
// adjacent on this curve.
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

// Merges neighboring cells of equal state, because conflicts are proven only in small cells.
// `diagram` has the durations of both motions.
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

DiagramCell::State state_of(CoordinationDiagram::CellState state) {
  using From = CoordinationDiagram::CellState;
  return state == From::free       ? DiagramCell::State::free
         : state == From::conflict ? DiagramCell::State::conflict
                                   : DiagramCell::State::undecided;
}

}  // namespace

void MotionChecker::look_at(PlanningScenePtr scene) {
  if (scene == store_.scene()) return;
  if (&scene->cell() != &store_.scene()->cell()) {
    store_ = MotionStore(std::move(scene));
  } else {
    store_.look_at(std::move(scene));
  }
  query_.reset();
}

Verdict MotionChecker::judge(const Question& question, CheckProgress* progress) {
  Verdict verdict;
  if (std::holds_alternative<TimedDiscrete>(question.method)) {
    if (!query_) query_.emplace(store_.scene());
    verdict = timed_discrete_check(question, *query_);
    if (!question.passages.empty()) store_.begin_question(progress);
  } else {
    store_.begin_question(progress);
    CertifiedCheck check(store_, question);
    verdict = std::holds_alternative<Swept>(question.method) ? check.swept() : check.coordinated();
  }
  for (const PassageQuestion& passage : question.passages) {
    check_passage(store_, passage, question.rest, tracking_errors_of(question.method), verdict);
  }
  if (progress != nullptr && progress->is_interrupted()) return interrupted(question);
  return verdict;
}

Verdict MotionChecker::interrupted(const Question& question) {
  store_ = MotionStore(store_.scene());
  Verdict verdict{.kind = Verdict::Kind::undecided, .version = question.version, .conflicts = {}};
  verdict.interrupted = true;
  return verdict;
}

Diagram MotionChecker::draw(const Drawing& drawing, CheckProgress* progress) {
  store_.begin_question(progress);
  Diagram diagram{drawing.a->duration(), drawing.b->duration(), {}, 0};
  const auto entry = [&](const TrajectoryPtr& motion, ArmId arm) -> MotionStore::Entry& {
    return store_.motion(motion, arm, drawing.rest, drawing.tracking_errors.of(arm));
  };
  for (const ArmId arm_a : drawing.a->arms()) {
    for (const ArmId arm_b : drawing.b->arms()) {
      if (arm_a == arm_b) continue;
      std::vector<DiagramCell>& cells = diagram.layers.emplace_back(arm_a, arm_b).cells;
      const OrientedDiagram pair = store_.between(entry(drawing.a, arm_a), entry(drawing.b, arm_b));
      if (!pair) {
        cells.push_back({Duration{}, diagram.duration_a, Duration{}, diagram.duration_b,
                         DiagramCell::State::free});
        continue;
      }
      diagram.evaluations += pair.refine(drawing.resolution, drawing.budget);
      for (const auto& [box, state] : pair.cells()) {
        cells.push_back({box.from_a, box.to_a, box.from_b, box.to_b, state_of(state)});
      }
      cells = joined(std::move(cells), diagram);
    }
  }
  return diagram;
}

}  // namespace armloom
