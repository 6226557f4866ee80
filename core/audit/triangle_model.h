#pragma once

#include <fcl/geometry/collision_geometry.h>

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "core/geometry/mesh/surface_tree.h"

namespace armloom {

// Triangles on their way into FCL.
struct TriangleModel {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Triangle> triangles;

  // FCL's distance of triangles is exact, but for those without area, of which it makes anything:
  // these get one, by a corner that is moved aside by at most kAside_m.
  [[nodiscard]] std::shared_ptr<fcl::CollisionGeometryd> made() const;
  static constexpr double kAside_m = 1e-6;
};

}  // namespace armloom
