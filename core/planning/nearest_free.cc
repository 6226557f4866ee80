#include "core/planning/nearest_free.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "core/collision/check/line_checker.h"
#include "core/planning/places_around.h"

namespace armloom {
namespace {

// The line from there to what is wanted is halved so often.
constexpr int kHalvings = 10;

// Along the line there. Precondition: `q` is free, `blocked` is not.
Eigen::VectorXd brought_nearer(LineChecker& states, Eigen::VectorXd blocked, Eigen::VectorXd q) {
  for (int i = 0; i < kHalvings; ++i) {
    Eigen::VectorXd middle = 0.5 * (q + blocked);
    (states.is_free(middle, middle) ? q : blocked) = std::move(middle);
  }
  return q;
}

// The same, one joint after the other, those that are nearest first: what is off at the end is off
// in few joints.
Eigen::VectorXd joint_by_joint(LineChecker& states, const Eigen::VectorXd& wanted,
                               Eigen::VectorXd q) {
  std::vector<Eigen::Index> joints(static_cast<std::size_t>(q.size()));
  std::iota(joints.begin(), joints.end(), Eigen::Index{0});
  std::ranges::sort(joints, {},
                    [&](Eigen::Index j) { return std::pair(std::abs(q[j] - wanted[j]), j); });
  for (Eigen::Index j : joints) {
    Eigen::VectorXd there = q;
    there[j] = wanted[j];
    q = states.is_free(there, there) ? there
                                     : brought_nearer(states, std::move(there), std::move(q));
  }
  return q;
}

}  // namespace

NearestFree nearest_free(const PlanningScenePtr& scene, const PlanRequest& request,
                         const Eigen::VectorXd& wanted) {
  const Cell& cell = scene->cell();
  const Arm& arm = cell.arm(request.arm);
  LineChecker states(scene, request.arm, request.at, cell.checking.tracking_error_rad,
                     request.left_out);
  const Eigen::VectorXd centre = within_limits(cell, arm, wanted);
  if (states.is_free(centre, centre)) return {centre, states.evaluations()};
  std::optional<Eigen::VectorXd> nearest;
  int found = 0;
  for (int i = 1; i <= kPlacesLookedAt && found < kFreePlacesMax; ++i) {
    Eigen::VectorXd q = place_around(cell, arm, centre, i);
    if (!states.is_free(q, q)) continue;
    ++found;
    q = joint_by_joint(states, centre, brought_nearer(states, centre, std::move(q)));
    if (!nearest || (q - wanted).norm() < (*nearest - wanted).norm()) nearest = std::move(q);
  }
  return {std::move(nearest), states.evaluations()};
}

}  // namespace armloom
