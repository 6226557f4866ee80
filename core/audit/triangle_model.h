#pragma once

#include <fcl/geometry/collision_geometry.h>

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "core/geometry/mesh/surface_tree.h"

namespace armloom {

// Triangles to be passed to FCL.
struct TriangleModel {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Triangle> triangles;

  // Builds the FCL model. FCL's triangle distance is arbitrary for triangles without area, so one
  // of their corners is moved by at most kAside_m.
  [[nodiscard]] std::shared_ptr<fcl::CollisionGeometryd> made() const;
  static constexpr double kAside_m = 1e-6;
};

}  // namespace armloom
