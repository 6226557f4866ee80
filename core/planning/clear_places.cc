#include "core/planning/clear_places.h"

#include <algorithm>

#include "core/collision/check/line_checker.h"
#include "core/collision/check/motion_checker.h"
#include "core/planning/places_around.h"
#include "core/trajectory/set_joints.h"

namespace armloom {
namespace {

class Clearing {
 public:
  Clearing(const PlanningScenePtr& scene, const InTheWay& way, const Configuration& at)
      : cell_(scene->cell()),
        way_(way),
        at_(at),
        states_(scene, way.arm, at, TrackingErrors(cell_)),
        motions_(scene) {}

  [[nodiscard]] bool is_clear(const Eigen::VectorXd& q) {
    return states_.is_free(q, q) && lets_pass(q);
  }
  [[nodiscard]] std::uint64_t evaluations() const { return states_.evaluations() + of_motions_; }

 private:
  [[nodiscard]] bool lets_pass(const Eigen::VectorXd& q) {
    set_joints(at_, cell_.arm(way_.arm).joints, q);
    const Verdict verdict =
        motions_.judge({.version = 0,
                        .start_at = TimePoint{},
                        .candidates = {{StepId{JobId{0}}, way_.motion, way_.progress}},
                        .others = {},
                        .rest = at_,
                        .method = Swept{TrackingErrors(cell_)}});
    of_motions_ += verdict.evaluations;
    if (verdict.kind == Verdict::Kind::free) return true;
    // Only conflicts with this arm matter, because other conflicts of the motion do not depend on
    // it.
    const bool is_told = !verdict.conflicts.empty();
    return is_told && std::ranges::none_of(verdict.conflicts, [&](const Conflict& conflict) {
             return conflict.with == Conflict::With::rest && conflict.proximity.arm_b == way_.arm;
           });
  }

  const Cell& cell_;
  const InTheWay& way_;
  Configuration at_;
  LineChecker states_;
  MotionChecker motions_;
  std::uint64_t of_motions_ = 0;
};

}  // namespace

tl::expected<ClearPlaces, PlanRefusal> places_clear_of(const PlanningScenePtr& scene,
                                                       const InTheWay& way,
                                                       const Configuration& at) {
  const Cell& cell = scene->cell();
  const Arm& arm = cell.arm(way.arm);
  const Eigen::VectorXd stands = joints_of(at, arm.joints);
  Clearing clearing(scene, way, at);
  std::vector<Eigen::VectorXd> found;
  for (int i = 1; i <= kPlacesLookedAt && found.size() < kClearPlacesMax; ++i) {
    Eigen::VectorXd q = place_around(cell, arm, stands, i);
    if (clearing.is_clear(q)) found.push_back(std::move(q));
  }
  if (found.empty()) {
    return tl::unexpected(PlanRefusal{PlanRefusal::Reason::goal_not_reached,
                                      "none of " + std::to_string(kPlacesLookedAt) +
                                          " configurations of arm " + arm.name +
                                          " is free and out of the way",
                                      {},
                                      clearing.evaluations()});
  }
  std::ranges::stable_sort(found, {}, [&](const auto& q) { return (q - stands).norm(); });
  return ClearPlaces{std::move(found), clearing.evaluations()};
}

}  // namespace armloom
