#include "core/planning/plan_motion.h"

#include "core/collision/check/motion_checker.h"

namespace armloom {
namespace {

// How widely corners are cut, tried in this order; rad or m in joint space.
constexpr double kRoundings[] = {0.2, 0.05, 0.01, 0.002};

bool is_free(MotionChecker& checker, const PlanRequest& request, const TrajectoryPtr& trajectory) {
  const double tracking_error = checker.scene()->cell().checking.tracking_error_rad;
  const Verdict verdict = checker.judge({.version = 0,
                                         .start_at = TimePoint{},
                                         .candidates = {{JobId{0}, trajectory, Duration{}}},
                                         .others = {},
                                         .rest = request.at,
                                         .method = Swept{tracking_error}});
  return verdict.kind == Verdict::Kind::free;
}

}  // namespace

tl::expected<PlannedMotion, PlanRefusal> plan_motion(const Planner& planner,
                                                     const PlanRequest& request,
                                                     const TimingOptions& options) {
  auto way = planner.plan(request);
  if (!way) return tl::unexpected(std::move(way.error()));
  const Cell& cell = planner.scene()->cell();
  const auto& joints = cell.arm(request.arm).joints;
  MotionChecker checker(planner.scene());
  if (way->points.size() > 2) {
    for (const double within : kRoundings) {
      auto timed = time_path(cell, joints, JointPath::rounded(way->points, within), options);
      if (!timed || !is_free(checker, request, timed->trajectory)) continue;
      return PlannedMotion{*std::move(way), *std::move(timed), within};
    }
  }
  auto timed = time_lines(cell, joints, way->points, options);
  if (!timed) {
    return tl::unexpected(PlanRefusal{PlanRefusal::Reason::outside_limits,
                                      timed.error().front().detail, std::nullopt,
                                      way->evaluations});
  }
  if (!is_free(checker, request, timed->trajectory)) {
    return tl::unexpected(PlanRefusal{PlanRefusal::Reason::not_found,
                                      "the way that was found was not judged free as a job",
                                      std::nullopt, way->evaluations});
  }
  return PlannedMotion{*std::move(way), *std::move(timed), 0.0};
}

}  // namespace armloom
