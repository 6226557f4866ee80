#include "core/planning/places_around.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/planning/halton.h"

namespace armloom {
namespace {

// Maximum distance of candidates from the center for a joint without limits (rad or m).
constexpr double kFarthest = std::numbers::pi;

}  // namespace

Eigen::VectorXd place_around(const Cell& cell, const Arm& arm, const Eigen::VectorXd& centre,
                             int i) {
  const double reach = static_cast<double>(i) / kPlacesLookedAt;
  Eigen::VectorXd q = halton(i, centre.size());
  for (Eigen::Index j = 0; j < q.size(); ++j) {
    const Joint& joint = cell.joint(arm.joints[static_cast<std::size_t>(j)]);
    const bool ranged = joint.has_lower() && joint.has_upper();
    const double far = ranged ? joint.upper - joint.lower : kFarthest;
    q[j] = centre[j] + reach * far * (2.0 * q[j] - 1.0);
  }
  return within_limits(cell, arm, std::move(q));
}

Eigen::VectorXd within_limits(const Cell& cell, const Arm& arm, Eigen::VectorXd q) {
  for (Eigen::Index j = 0; j < q.size(); ++j) {
    const Joint& joint = cell.joint(arm.joints[static_cast<std::size_t>(j)]);
    q[j] = std::clamp(q[j], joint.lower, joint.upper);
  }
  return q;
}

}  // namespace armloom
