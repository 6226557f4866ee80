#include "core/planning/plan_motion.h"

#include <algorithm>

#include "core/collision/check/motion_checker.h"

namespace armloom {
namespace {

// Maximum corner cuts in the order in which they are tried (rad or m in joint space).
constexpr double kRoundings[] = {0.2, 0.05, 0.01, 0.002};

// Number of seeds to try. A path that is certified line by line may still fail the check as a job,
// whose diagram has other cells.
constexpr int kTries = 3;

}  // namespace

std::optional<Conflict> found_in_the_way(MotionChecker& checker, const PlanRequest& request,
                                         const TrajectoryPtr& trajectory) {
  const Verdict verdict = checker.judge({.version = 0,
                                         .start_at = TimePoint{},
                                         .candidates = {{StepId{JobId{0}}, trajectory, Duration{}}},
                                         .others = {},
                                         .rest = request.at,
                                         .method = Swept{TrackingErrors(checker.scene()->cell())}});
  if (verdict.kind == Verdict::Kind::free) return std::nullopt;
  if (verdict.conflicts.empty())
    return Conflict{Conflict::With::self, StepId{JobId{0}}, {}, {}, {}, {}};
  // The check also finds conflicts with arms that the request ignores.
  const auto counts = [&](const Conflict& conflict) {
    const auto& arm = conflict.proximity.arm_b;
    return conflict.with != Conflict::With::rest || !arm ||
           std::ranges::find(request.left_out, *arm) == request.left_out.end();
  };
  const auto found = std::ranges::find_if(verdict.conflicts, counts);
  return found == verdict.conflicts.end() ? std::nullopt : std::optional(*found);
}

namespace {

bool is_free(MotionChecker& checker, const PlanRequest& request, const TrajectoryPtr& trajectory) {
  return !found_in_the_way(checker, request, trajectory);
}

// Returns the path with times, or nullopt if no timing of it is certified free.
std::optional<PlannedMotion> timed_way(MotionChecker& checker, const PlanRequest& request,
                                       const JointWay& way, const TimingOptions& options) {
  const Cell& cell = checker.scene()->cell();
  const auto& joints = cell.arm(request.arm).joints;
  if (way.points.size() > 2) {
    for (const double within : kRoundings) {
      auto timed = time_path(cell, joints, JointPath::rounded(way.points, within), options);
      if (!timed || !is_free(checker, request, timed->trajectory)) continue;
      return PlannedMotion{way, *std::move(timed), within};
    }
  }
  auto timed = time_lines(cell, joints, way.points, options);
  if (!timed || !is_free(checker, request, timed->trajectory)) return std::nullopt;
  return PlannedMotion{way, *std::move(timed), 0.0};
}

}  // namespace

tl::expected<PlannedMotion, PlanRefusal> plan_motion(const Planner& planner,
                                                     const PlanRequest& request,
                                                     const TimingOptions& options) {
  MotionChecker checker(planner.scene());
  PlanRequest again = request;
  std::uint64_t evaluations = 0;
  for (int i = 0; i < kTries && evaluations < request.budget; ++i) {
    again.seed = request.seed + static_cast<std::uint64_t>(i);
    again.budget = request.budget - evaluations;
    auto way = planner.plan(again);
    if (!way) return tl::unexpected(std::move(way.error()));
    evaluations += way->evaluations;
    if (auto motion = timed_way(checker, again, *way, options)) {
      motion->way.evaluations = evaluations;
      return *std::move(motion);
    }
  }
  return tl::unexpected(PlanRefusal{PlanRefusal::Reason::not_found,
                                    "the path that was found passes something too closely to be "
                                    "certified as a job",
                                    std::nullopt, evaluations});
}

}  // namespace armloom
