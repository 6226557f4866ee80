#include "test/bench/link_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "core/geometry/mesh/convex_hull.h"

namespace armloom::bench {
namespace {

// qhull may leave a point kHullTolerance_m outside of a face. The mesh is larger by twice that.
constexpr double kMargin_m = 2.0 * kHullTolerance_m;

// Returns the largest n·p over the body's points p in P; n has unit length.
double support(const ConvexShape& body, const Eigen::Vector3d& n) {
  const Eigen::Vector3d n_S = body.X_PS.linear().transpose() * n;
  const double middle = n.dot(body.X_PS.translation());
  const double along = std::abs(n_S.z()) * body.half_length_m;
  switch (body.kind) {
    case ConvexShapeKind::box:
      return middle + n_S.cwiseAbs().dot(body.half_size_m);
    case ConvexShapeKind::cylinder:
      return middle + along + body.radius_m * std::hypot(n_S.x(), n_S.y());
    case ConvexShapeKind::hull:
      return middle + body.hull->support(n_S);
    case ConvexShapeKind::round:
      break;
  }
  return middle + along + body.radius_m;
}

double support(const std::vector<ConvexShape>& bodies, const Eigen::Vector3d& n) {
  double largest = -std::numeric_limits<double>::infinity();
  for (const ConvexShape& body : bodies) largest = std::max(largest, support(body, n));
  return largest;
}

// A spiral with the golden angle.
std::vector<Eigen::Vector3d> directions(std::size_t count) {
  const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
  std::vector<Eigen::Vector3d> all;
  for (std::size_t i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(count);
    const double r = std::sqrt(1.0 - z * z);
    const double angle = golden * static_cast<double>(i);
    all.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
  }
  return all;
}

ConvexHull hull_of(const std::vector<Eigen::Vector3d>& points) {
  auto hull = convex_hull(points);
  if (!hull) throw std::runtime_error("link mesh: " + hull.error());
  return std::move(*hull);
}

Eigen::Vector3d normal(const ConvexHull& hull, const std::array<std::uint32_t, 3>& face) {
  const Eigen::Vector3d& a = hull.vertices[face[0]];
  return (hull.vertices[face[1]] - a).cross(hull.vertices[face[2]] - a).normalized();
}

}  // namespace

LinkMesh circumscribed_mesh(const std::vector<ConvexShape>& bodies, std::size_t triangles) {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  for (const ConvexShape& body : bodies) center += body.X_PS.translation();
  center /= static_cast<double>(bodies.size());

  // The plane at height h along n is the point n / h of the dual; the polytope's corners are the
  // faces of the dual's hull.
  std::vector<Eigen::Vector3d> dual;
  for (const Eigen::Vector3d& n : directions((triangles + 8) / 4)) {
    dual.push_back(n / (support(bodies, n) - n.dot(center) + kMargin_m));
  }
  const ConvexHull planes = hull_of(dual);
  std::vector<Eigen::Vector3d> corners;
  for (const auto& face : planes.faces) {
    const Eigen::Vector3d n = normal(planes, face);
    corners.push_back(center + n / n.dot(planes.vertices[face[0]]));
  }
  const ConvexHull mesh = hull_of(corners);
  for (const auto& face : mesh.faces) {
    const Eigen::Vector3d n = normal(mesh, face);
    if (!n.allFinite()) continue;  // a degenerate face without area
    if (n.dot(mesh.vertices[face[0]]) < support(bodies, n)) {
      throw std::logic_error("link mesh: a body leaves its mesh");
    }
  }
  return {mesh.vertices, mesh.faces};
}

}  // namespace armloom::bench
