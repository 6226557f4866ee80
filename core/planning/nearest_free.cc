#include "core/planning/nearest_free.h"

#include <utility>

#include "core/collision/check/line_checker.h"
#include "core/planning/places_around.h"

namespace armloom {
namespace {

// Number of bisections of the line to the wanted position.
constexpr int kHalvings = 10;
constexpr int kSweeps = 2;  // passes over all joints

// Moves q toward `blocked`, as near as bisection finds it free. Precondition: `q` is free,
// `blocked` is not.
Eigen::VectorXd brought_nearer(LineChecker& states, Eigen::VectorXd blocked, Eigen::VectorXd q) {
  for (int i = 0; i < kHalvings; ++i) {
    Eigen::VectorXd middle = 0.5 * (q + blocked);
    (states.is_free(middle, middle) ? q : blocked) = std::move(middle);
  }
  return q;
}

// Tries to reset one joint after the other to its wanted position. The other joints first move
// farther away, so that the distance from `wanted` stays the same. If that position is free, all
// joints are then moved toward `wanted` again.
Eigen::VectorXd by_fewer_joints(LineChecker& states, const Cell& cell, const Arm& arm,
                                const Eigen::VectorXd& wanted, Eigen::VectorXd q) {
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (Eigen::Index j = 0; j < q.size(); ++j) {
      Eigen::VectorXd off = q - wanted;
      const double far = off.norm();
      off[j] = 0.0;
      if (off.norm() == 0.0 || off.norm() == far) continue;
      Eigen::VectorXd fewer = within_limits(cell, arm, wanted + far / off.norm() * off);
      if (states.is_free(fewer, fewer)) q = brought_nearer(states, wanted, std::move(fewer));
    }
  }
  return q;
}

}  // namespace

NearestFree nearest_free(const PlanningScenePtr& scene, const PlanRequest& request,
                         const Eigen::VectorXd& wanted) {
  const Cell& cell = scene->cell();
  const Arm& arm = cell.arm(request.arm);
  LineChecker states(scene, request.arm, request.at, TrackingErrors(cell), request.left_out);
  const Eigen::VectorXd centre = within_limits(cell, arm, wanted);
  if (states.is_free(centre, centre)) return {centre, states.evaluations()};
  std::optional<Eigen::VectorXd> nearest;
  int found = 0;
  for (int i = 1; i <= kPlacesLookedAt && found < kFreePlacesMax; ++i) {
    Eigen::VectorXd q = place_around(cell, arm, centre, i);
    if (!states.is_free(q, q)) continue;
    ++found;
    q = by_fewer_joints(states, cell, arm, centre, brought_nearer(states, centre, std::move(q)));
    if (!nearest || (q - wanted).norm() < (*nearest - wanted).norm()) nearest = std::move(q);
  }
  return {std::move(nearest), states.evaluations()};
}

}  // namespace armloom
