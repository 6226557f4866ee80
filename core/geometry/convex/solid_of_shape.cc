#include "core/geometry/convex/solid_of_shape.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

namespace armloom {
namespace {

using Eigen::Vector3d;

SurfaceTreePtr box_tree(const Vector3d& half) {
  std::vector<Vector3d> vertices;
  for (int i = 0; i < 8; ++i) {
    vertices.emplace_back(i & 1 ? half.x() : -half.x(), i & 2 ? half.y() : -half.y(),
                          i & 4 ? half.z() : -half.z());
  }
  std::vector<Triangle> triangles{{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                                  {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return make_surface_tree(std::move(vertices), std::move(triangles), false);
}

// Returns a prism whose sides touch the cylinder, with a vertex at the center of each end.
SurfaceTreePtr prism_tree(double radius_m, double half_length_m) {
  // Half the angle of a side.
  const double angle = std::acos(radius_m / (radius_m + kPrismOverestimate_m));
  const auto count = static_cast<std::uint32_t>(
      std::clamp(std::ceil(std::numbers::pi / angle), 16.0, double{kPrismCornersMost}));
  // A little more than needed, for rounding.
  const double r = radius_m / std::cos(std::numbers::pi / count) * (1.0 + 1e-12);
  std::vector<Vector3d> vertices{{0, 0, -half_length_m}, {0, 0, half_length_m}};
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double turn = 2.0 * std::numbers::pi * i / count;
    for (const double z : {-half_length_m, half_length_m}) {
      vertices.emplace_back(r * std::cos(turn), r * std::sin(turn), z);
    }
    const std::uint32_t low = 2 + 2 * i;
    const std::uint32_t next = 2 + 2 * ((i + 1) % count);
    triangles.push_back({0, next, low});
    triangles.push_back({1, low + 1, next + 1});
    triangles.push_back({low, next, next + 1});
    triangles.push_back({low, next + 1, low + 1});
  }
  return make_surface_tree(std::move(vertices), std::move(triangles));
}

}  // namespace

SolidPtr solid_of(const ConvexShape& body) {
  Solid solid;
  solid.X_PT = body.X_PS;
  switch (body.kind) {
    case ConvexShapeKind::round:
      solid.tree =
          make_surface_tree({{0, 0, -body.half_length_m}, {0, 0, body.half_length_m}}, {{0, 1, 1}});
      solid.radius_m = body.radius_m;
      solid.inner = InnerBalls({{{0, 0, -body.half_length_m}, body.radius_m},
                                {{0, 0, 0}, body.radius_m},
                                {{0, 0, body.half_length_m}, body.radius_m}});
      break;
    case ConvexShapeKind::cylinder:
      solid.tree = prism_tree(body.radius_m, body.half_length_m);
      solid.inner = InnerBalls(
          inner_balls(Vector3d::Zero(), {body.radius_m, body.radius_m, body.half_length_m},
                      [&](const Vector3d& p) {
                        return std::min(body.radius_m - std::hypot(p.x(), p.y()),
                                        body.half_length_m - std::abs(p.z()));
                      }));
      break;
    case ConvexShapeKind::box:
      solid.tree = box_tree(body.half_size_m);
      solid.inner =
          InnerBalls(inner_balls(Vector3d::Zero(), body.half_size_m, [&](const Vector3d& p) {
            return (body.half_size_m - p.cwiseAbs()).minCoeff();
          }));
      break;
    case ConvexShapeKind::hull:
      solid.tree = make_surface_tree(body.hull->hull.vertices, body.hull->hull.faces);
      solid.inner = InnerBalls(inner_balls(*solid.tree));
      break;
  }
  return std::make_shared<const Solid>(std::move(solid));
}

}  // namespace armloom
