#include "core/collision/check/motion_checker.h"

#include "core/collision/check/certified_check.h"
#include "core/collision/check/joined_cells.h"
#include "core/collision/check/timed_discrete_check.h"

namespace armloom {
namespace {

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
  query_ = ClearanceQuery(store_.scene());
}

Verdict MotionChecker::judge(const Question& question, CheckProgress* progress) {
  Verdict verdict;
  if (std::holds_alternative<TimedDiscrete>(question.method)) {
    verdict = timed_discrete_check(question, query_);
    if (!question.passages.empty()) store_.begin_question(progress);
  } else {
    store_.begin_question(progress);
    CertifiedCheck check(store_, question);
    verdict = std::holds_alternative<Swept>(question.method) ? check.swept() : check.coordinated();
  }
  for (const PassageQuestion& passage : question.passages) {
    verdict.passages.push_back(check_passage(
        store_, passage, question.rest, tracking_error_of(question.method), verdict.evaluations));
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
    return store_.motion(motion, arm, drawing.rest, drawing.tracking_error);
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
