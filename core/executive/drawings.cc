#include "core/executive/drawings.h"

#include <algorithm>
#include <utility>

#include "core/executive/arms_of.h"
#include "core/executive/plan_ahead.h"

namespace armloom {
namespace {

// Resolution for motions of some seconds; coarser if it takes too many cells.
constexpr Duration kResolution = std::chrono::milliseconds(10);
constexpr std::uint64_t kCells = 24'000;
constexpr std::size_t kDrawnMax = 4;

bool share_no_space(const Trajectory& a, const Trajectory& b) {
  return a.arms().size() == 1 && a.arms() == b.arms();
}

// Adds the diagram, and the first conflict ahead of both motions.
DiagramView shown(DiagramView view, const Diagram& diagram, const Cell& cell) {
  view.evaluations = diagram.evaluations;
  for (const DiagramLayer& layer : diagram.layers) {
    view.layers.push_back({cell.arm(layer.arm_a).name, cell.arm(layer.arm_b).name, layer.cells,
                           first_met(layer.cells, view.a.progress, view.b.progress, view.a.duration,
                                     view.b.duration)});
  }
  return view;
}

}  // namespace

Result<const Step*> Drawings::known(const std::string& key, const std::string& pointer) const {
  if (const auto id = jobs_.find(key)) return scheduler_.find(tasks_.present_motion(*id));
  return failure(Problem{ProblemKind::not_found, "no-such-job", pointer,
                         "there is no job \"" + key + "\"", key});
}

DiagramView::Side Drawings::side_of(const Step& step) const {
  const JobId id = tasks_.told(step.id.job);
  return {.job = jobs_.key(id),
          .state = jobs_.state(id),
          .duration = step.trajectory->duration(),
          .progress = std::clamp(step.progress, Duration{}, step.trajectory->duration())};
}

void Drawings::draw(const Asked& asked, std::function<void(Result<DiagramView>)> done) {
  const auto& [scene, scene_version] = asked.in;
  const Cell& cell = scene->cell();
  const auto a = known(asked.key_a, "request target");
  if (!a) return done(failure(a.error()));
  const auto b = known(asked.key_b, "?with");
  if (!b) return done(failure(b.error()));
  const auto refuse = [&](const char* slug, std::string detail) {
    done(failure(Problem{ProblemKind::invalid, slug, "?with", std::move(detail), asked.key_b}));
  };
  if (*a == *b)
    return refuse("same-job",
                  "a diagram needs two different jobs, found \"" + asked.key_b + "\" twice");
  const TrajectoryPtr motion_a = (*a)->trajectory;
  const TrajectoryPtr motion_b = (*b)->trajectory;
  if (share_no_space(*motion_a, *motion_b)) {
    return refuse("same-arm",
                  "both jobs move arm " + names_of(cell, motion_b->arms()) +
                      ", so they run one after the other: choose jobs of different arms");
  }
  DiagramView view{
      .time = asked.now, .a = side_of(**a), .b = side_of(**b), .scene_version = scene_version};
  const auto cached = std::ranges::find_if(drawn_, [&](const Drawn& drawn) {
    return drawn.a == motion_a && drawn.b == motion_b && drawn.scene_version == scene_version &&
           drawn.rest == scheduler_.state().arms.rest();
  });
  if (cached != drawn_.end()) return done(shown(std::move(view), cached->diagram, cell));
  Drawing drawing{.a = motion_a,
                  .b = motion_b,
                  .rest = scheduler_.state().arms.rest(),
                  .tracking_errors = TrackingErrors(cell),
                  .resolution = kResolution,
                  .budget = kCells};
  Drawn remembered{motion_a, motion_b, scheduler_.state().arms.rest(), scene_version, {}};
  const auto drawn = [this, &cell, view = std::move(view), done,
                      remembered = std::move(remembered)](Diagram diagram) mutable {
    remembered.diagram = std::move(diagram);
    done(shown(std::move(view), remembered.diagram, cell));
    drawn_.push_front(std::move(remembered));
    if (drawn_.size() > kDrawnMax) drawn_.pop_back();
  };
  if (judges_.draw(std::move(drawing), scene, drawn)) return;
  done(failure(Problem{ProblemKind::unavailable, "too-many-diagrams", "",
                       "too many diagrams are open; retry in a moment"}));
}

}  // namespace armloom
