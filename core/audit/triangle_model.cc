#include "core/audit/triangle_model.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/OBBRSS.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <utility>

namespace armloom {
namespace {

using Eigen::Vector3d;

bool lacks_area(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const double longest_m = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
  return (b - a).cross(c - a).norm() <= 1e-9 * longest_m;  // its height is below a nanometer
}

// Returns three corners with an area, each near a given corner.
std::array<Vector3d, 3> spread(Vector3d a, Vector3d b, Vector3d c) {
  constexpr double kAside_m = TriangleModel::kAside_m;
  // Keeps the longest side and moves the opposite corner.
  if ((c - b).norm() > (b - a).norm()) std::swap(a, c);
  if ((c - a).norm() > (b - a).norm()) std::swap(b, c);
  if ((b - a).norm() < kAside_m) b = a + kAside_m * Vector3d::UnitX();
  return {a, b, c + kAside_m * (b - a).unitOrthogonal()};
}

}  // namespace

std::shared_ptr<fcl::CollisionGeometryd> TriangleModel::made() const {
  std::vector<Vector3d> points = vertices;
  std::vector<fcl::Triangle> listed;
  for (const Triangle& t : triangles) {
    const Vector3d& a = vertices[t[0]];
    const Vector3d& b = vertices[t[1]];
    const Vector3d& c = vertices[t[2]];
    if (!lacks_area(a, b, c)) {
      listed.emplace_back(t[0], t[1], t[2]);
      continue;
    }
    const std::size_t first = points.size();
    for (const Vector3d& p : spread(a, b, c)) points.push_back(p);
    listed.emplace_back(first, first + 1, first + 2);
  }
  auto model = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
  model->beginModel(static_cast<int>(listed.size()), static_cast<int>(points.size()));
  model->addSubModel(points, listed);
  model->endModel();
  model->computeLocalAABB();
  return model;
}

}  // namespace armloom
