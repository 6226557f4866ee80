// The coordination diagram of two jobs, for people who want to see why one waits.
#include <algorithm>
#include <utility>

#include "core/executive/executive_impl.h"

namespace armloom {
namespace {

// As fine as a picture of some seconds can show; where that takes more cells (longer motions, much
// conflict), coarser ones. A fraction of a second, on a thread that nobody waits for.
constexpr Duration kResolution = std::chrono::milliseconds(10);
constexpr std::uint64_t kCells = 24'000;
// Whoever looks at one asks again and again where its two are by now.
constexpr std::size_t kDrawnMax = 4;

bool share_no_space(const Trajectory& a, const Trajectory& b) {
  return a.arms().size() == 1 && a.arms() == b.arms();
}

}  // namespace

Result<const Job*> Executive::Impl::known(const std::string& key,
                                          const std::string& pointer) const {
  const auto it = ids_.find(key);
  if (it != ids_.end()) return scheduler_.find(it->second);
  return failure(Problem{ProblemKind::not_found, "no-such-job", pointer,
                         "there is no job \"" + key + "\"", key});
}

DiagramView::Side Executive::Impl::side_of(const Job& job) const {
  return {.job = key(job.id),
          .state = job.state(),
          .duration = job.trajectory->duration(),
          .progress = std::clamp(job.progress, Duration{}, job.trajectory->duration())};
}

// The diagram, with what lies ahead of where the two are.
DiagramView Executive::Impl::shown(DiagramView view, const Diagram& diagram) const {
  view.evaluations = diagram.evaluations;
  for (const DiagramLayer& layer : diagram.layers) {
    view.layers.push_back({cell_->arm(layer.arm_a).name, cell_->arm(layer.arm_b).name, layer.cells,
                           first_met(layer.cells, view.a.progress, view.b.progress, view.a.duration,
                                     view.b.duration)});
  }
  return view;
}

void Executive::Impl::diagram(const std::string& key_a, const std::string& key_b,
                              std::function<void(Result<DiagramView>)> done) {
  const auto a = known(key_a, "request target");
  if (!a) return done(failure(a.error()));
  const auto b = known(key_b, "?with");
  if (!b) return done(failure(b.error()));
  const auto refuse = [&](const char* slug, std::string detail) {
    done(failure(Problem{ProblemKind::invalid, slug, "?with", std::move(detail), key_b}));
  };
  if (*a == *b)
    return refuse("same-job", "a diagram is of two jobs, found \"" + key_b + "\" twice");
  const TrajectoryPtr motion_a = (*a)->trajectory;
  const TrajectoryPtr motion_b = (*b)->trajectory;
  if (share_no_space(*motion_a, *motion_b)) {
    return refuse("same-arm", "both jobs move arm " + names_of(motion_b->arms()) +
                                  ": one comes after the other");
  }
  DiagramView view{
      .time = now_, .a = side_of(**a), .b = side_of(**b), .scene_version = scene_version_};
  const auto cached = std::ranges::find_if(drawn_, [&](const Drawn& drawn) {
    return drawn.a == motion_a && drawn.b == motion_b && drawn.scene_version == scene_version_ &&
           drawn.rest == scheduler_.rest();
  });
  if (cached != drawn_.end()) return done(shown(std::move(view), cached->diagram));
  Drawing drawing{.a = motion_a,
                  .b = motion_b,
                  .rest = scheduler_.rest(),
                  .tracking_error = cell_->checking.tracking_error_rad,
                  .resolution = kResolution,
                  .budget = kCells};
  Drawn remembered{motion_a, motion_b, scheduler_.rest(), scene_version_, {}};
  const auto drawn = [this, view = std::move(view), done,
                      remembered = std::move(remembered)](Diagram diagram) mutable {
    remembered.diagram = std::move(diagram);
    done(shown(std::move(view), remembered.diagram));
    drawn_.push_front(std::move(remembered));
    if (drawn_.size() > kDrawnMax) drawn_.pop_back();
  };
  if (judges_.draw(std::move(drawing), scene_, drawn)) return;
  done(failure(Problem{ProblemKind::unavailable, "too-many-diagrams", "",
                       "too many diagrams are being drawn; ask again in a moment"}));
}

}  // namespace armloom
