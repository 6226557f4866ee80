#include "core/geometry/surface/solid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/surface/enclosure.h"

namespace armloom {
namespace {

using Eigen::Vector3d;
// Returns true if a component of `inner` is inside `outer`. Precondition: the surfaces do not
// touch.
bool lies_inside(const SurfaceTree& inner, const SurfaceTree& outer,
                 const Eigen::Isometry3d& X_OI) {
  if (!outer.encloses) return false;
  const Vector3d center = outer.root.center.cast<double>();
  const Vector3d half = outer.root.half.cast<double>();
  return std::any_of(inner.components.begin(), inner.components.end(), [&](const auto& component) {
    const Vector3d p = X_OI * inner.vertices[component.vertex];
    if (((p - center).cwiseAbs().array() > half.array()).any()) return false;
    return may_enclose(outer, p);
  });
}

// Returns the pose of b's tree in a's tree frame.
Eigen::Isometry3d X_AB_of(const PlacedSolid& a, const PlacedSolid& b) {
  return a.X_WT.inverse(Eigen::Isometry) * b.X_WT;
}

double distance(const PlacedSolid& at_a, const PlacedSolid& at_b, double limit_m, double enough_m,
                const Roughness& rough = {}) {
  const Solid& a = at_a.solid;
  const Solid& b = at_b.solid;
  const Eigen::Isometry3d X_AB = X_AB_of(at_a, at_b);
  const double radii_m = a.radius_m + b.radius_m;
  if (limit_m + radii_m <= 0.0) return limit_m;
  if (a.inner.surely_meet(b.inner, X_AB, enough_m)) {
    return std::min(limit_m, 0.0);
  }
  const double within_m = limit_m + radii_m;
  SurfaceDescent descent(*a.tree, *b.tree, X_AB, within_m, enough_m + radii_m);
  descent.allow({rough.exact_below_m + radii_m, rough.by_m});
  const double closest_m = descent.run();
  const double found_m = closest_m < within_m ? std::min(closest_m - radii_m, limit_m) : limit_m;
  if (found_m <= 0.0) return std::min(limit_m, 0.0);
  if (found_m < enough_m || descent.boxes_apart()) return found_m;
  const bool inside = lies_inside(*a.tree, *b.tree, X_AB.inverse(Eigen::Isometry)) ||
                      lies_inside(*b.tree, *a.tree, X_AB);
  return inside ? std::min(limit_m, 0.0) : found_m;
}

}  // namespace

double solid_distance(const PlacedSolid& a, const PlacedSolid& b, double limit_m,
                      const Roughness& rough) {
  return distance(a, b, limit_m, 0.0, rough);
}

bool closer_than(const PlacedSolid& a, const PlacedSolid& b, double limit_m) {
  return distance(a, b, limit_m, limit_m) < limit_m;
}

bool surely_closer_than(const PlacedSolid& a, const PlacedSolid& b, double limit_m) {
  return a.solid.inner.surely_meet(b.solid.inner, X_AB_of(a, b), limit_m);
}

std::optional<Vector3d> direction_apart(const PlacedSolid& a, const PlacedSolid& b) {
  constexpr double kAny_m = std::numeric_limits<double>::infinity();
  SurfaceDescent descent(*a.solid.tree, *b.solid.tree, X_AB_of(a, b), kAny_m, 0.0);
  if (descent.run() <= 0.0) return std::nullopt;
  return a.X_WT.linear() * descent.direction();
}

bool surfaces_apart(const PlacedSolid& a, const PlacedSolid& b, double within_m, KeptApart& kept) {
  const double enough_m = within_m + a.solid.radius_m + b.solid.radius_m;
  SurfaceDescent descent(*a.solid.tree, *b.solid.tree, X_AB_of(a, b), enough_m, enough_m);
  descent.pass_over(&kept);
  return descent.run() >= enough_m;
}

}  // namespace armloom
