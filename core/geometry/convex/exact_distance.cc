#include "core/geometry/convex/exact_distance.h"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <cmath>
#include <exception>

namespace armloom {

class ExactGeometry {
 public:
  explicit ExactGeometry(std::shared_ptr<fcl::CollisionGeometryd> geometry)
      : geometry_(std::move(geometry)) {
    geometry_->computeLocalAABB();
  }
  [[nodiscard]] const fcl::CollisionGeometryd* get() const { return geometry_.get(); }

 private:
  std::shared_ptr<fcl::CollisionGeometryd> geometry_;
};

namespace {

// FCL's tolerance bounds one GJK step, not the error of the distance. At a tolerance of 1e-12 the
// error is below 1e-7 m.
constexpr double kGjkTolerance = 1e-12;
// If FCL's distance exceeds the proven gap by this, GJK stopped early. With libccd's GJK this
// happens for 1 in 20 pairs of boxes rotated about parallel axes, and for 1 in 5000 of other
// shapes; for boxes it may also report false contact. Then FCL's own solver is tried, then libccd's
// with the bodies swapped, and last the nearest triangles of the surfaces.
constexpr double kProofGap_m = 5e-7;

// Returns the largest n·(x - center) over the body; n of unit length, in world axes.
double support(const ConvexShape& body, const Eigen::Isometry3d& X_WS, const Eigen::Vector3d& n_W) {
  const Eigen::Vector3d n = X_WS.linear().transpose() * n_W;
  const double along = std::abs(n.z()) * body.half_length_m;
  switch (body.kind) {
    case ConvexShapeKind::box:
      return n.cwiseAbs().dot(body.half_size_m);
    case ConvexShapeKind::cylinder:
      return along + body.radius_m * std::hypot(n.x(), n.y());
    case ConvexShapeKind::hull:
      return body.hull->support(n);
    case ConvexShapeKind::round:
      break;
  }
  return along + body.radius_m;
}

// Returns the bodies' gap along n; negative if they overlap along n.
double gap_along(const ConvexShape& a, const Eigen::Isometry3d& X_WA, const ConvexShape& b,
                 const Eigen::Isometry3d& X_WB, const Eigen::Vector3d& n) {
  return n.dot(X_WB.translation() - X_WA.translation()) - support(a, X_WA, n) -
         support(b, X_WB, -n);
}

// FCL's distance (claimed) and the gap between two separating planes (proven). The normal n of the
// planes is the direction from a to b between FCL's nearest points. Both lengths are zero in
// contact.
struct Proof {
  double claimed;
  double proven;
  Eigen::Vector3d n;
  bool failed = false;  // FCL threw

  [[nodiscard]] bool is_settled() const { return proven > 0.0 && claimed - proven < kProofGap_m; }
};

Proof prove(const ConvexShape& a, const Eigen::Isometry3d& X_WA, const ConvexShape& b,
            const Eigen::Isometry3d& X_WB, fcl::GJKSolverType solver = fcl::GST_LIBCCD) try {
  fcl::DistanceRequestd request(true);
  request.gjk_solver_type = solver;
  request.distance_tolerance = kGjkTolerance;
  fcl::DistanceResultd result;
  const double distance =
      fcl::distance<double>(a.exact->get(), X_WA, b.exact->get(), X_WB, request, result);
  const Eigen::Vector3d gap = result.nearest_points[1] - result.nearest_points[0];
  const double length = gap.norm();
  if (!(distance > 0.0) || !(length > 0.0)) return {0.0, 0.0, gap};
  const Eigen::Vector3d n = gap / length;
  return {distance, std::clamp(gap_along(a, X_WA, b, X_WB, n), 0.0, distance), n};
} catch (const std::exception&) {
  return {0.0, 0.0, Eigen::Vector3d::Zero(), true};
}

// Finds separating planes across the direction between the surfaces' nearest triangles. Returns
// nullopt for pieces of a mesh, because their `solid` is the whole mesh.
std::optional<Separation> prove_by_surfaces(const ConvexShape& a, const Eigen::Isometry3d& X_WA,
                                            const ConvexShape& b, const Eigen::Isometry3d& X_WB) {
  if (a.solid == nullptr || b.solid == nullptr || a.is_piece || b.is_piece) return std::nullopt;
  // The solid's pose X_PT is given in the part's frame P, but X_WS is the pose of the shape's frame
  // S.
  const auto solid = [](const ConvexShape& body, const Eigen::Isometry3d& X_WS) {
    return PlacedSolid{*body.solid, X_WS * body.X_PS.inverse(Eigen::Isometry) * body.solid->X_PT};
  };
  const auto n = direction_apart(solid(a, X_WA), solid(b, X_WB));
  if (!n) return std::nullopt;
  const double gap = gap_along(a, X_WA, b, X_WB, *n);
  return gap > 0.0 ? std::optional(Separation{gap, *n}) : std::nullopt;
}

std::shared_ptr<fcl::CollisionGeometryd> convex_of(const ConvexHull& hull) {
  auto faces = std::make_shared<std::vector<int>>();
  for (const auto& face : hull.faces) {
    faces->push_back(3);
    for (const std::uint32_t i : face) faces->push_back(static_cast<int>(i));
  }
  return std::make_shared<fcl::Convexd>(
      std::make_shared<const std::vector<Eigen::Vector3d>>(hull.vertices),
      static_cast<int>(hull.faces.size()), std::move(faces));
}

}  // namespace

std::shared_ptr<const ExactGeometry> make_exact_geometry(const ConvexShape& body) {
  std::shared_ptr<fcl::CollisionGeometryd> geometry;
  switch (body.kind) {
    case ConvexShapeKind::box:
      geometry = std::make_shared<fcl::Boxd>(2.0 * body.half_size_m);
      break;
    case ConvexShapeKind::cylinder:
      geometry = std::make_shared<fcl::Cylinderd>(body.radius_m, 2.0 * body.half_length_m);
      break;
    case ConvexShapeKind::hull:
      geometry = convex_of(body.hull->hull);
      break;
    case ConvexShapeKind::round:
      if (body.half_length_m > 0.0) {
        geometry = std::make_shared<fcl::Capsuled>(body.radius_m, 2.0 * body.half_length_m);
      } else {
        geometry = std::make_shared<fcl::Sphered>(body.radius_m);
      }
      break;
  }
  return std::make_shared<const ExactGeometry>(std::move(geometry));
}

double exact_distance(const ConvexShape& a, const Eigen::Isometry3d& X_WA, const ConvexShape& b,
                      const Eigen::Isometry3d& X_WB) {
  const auto apart = exact_separation(a, X_WA, b, X_WB);
  return apart ? apart->distance_m : 0.0;
}

std::optional<Separation> exact_separation(const ConvexShape& a, const Eigen::Isometry3d& X_WA,
                                           const ConvexShape& b, const Eigen::Isometry3d& X_WB) {
  const Proof one = prove(a, X_WA, b, X_WB);
  Separation best{one.proven, one.n};
  // FCL may report contact of boxes that are apart.
  const bool boxes = a.kind == ConvexShapeKind::box && b.kind == ConvexShapeKind::box;
  if (one.failed || one.claimed - one.proven >= kProofGap_m || (boxes && !one.is_settled())) {
    const Proof other = prove(a, X_WA, b, X_WB, fcl::GST_INDEP);
    if (other.proven > best.distance_m) best = {other.proven, other.n};
    if (!other.is_settled()) {
      const Proof turned = prove(b, X_WB, a, X_WA);  // GJK then takes other steps
      if (turned.proven > best.distance_m) best = {turned.proven, -turned.n};
      const auto found = turned.is_settled() ? std::nullopt : prove_by_surfaces(a, X_WA, b, X_WB);
      if (found && found->distance_m > best.distance_m) best = *found;
    }
  }
  return best.distance_m > 0.0 ? std::optional(best) : std::nullopt;
}

}  // namespace armloom
