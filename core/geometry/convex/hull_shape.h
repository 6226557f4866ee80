#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "core/geometry/mesh/convex_hull.h"

namespace armloom {

// The convex hull of a mesh or piece, with its bounds. Its frame S is centered in a tight box
// around it (along the mesh's axes or the corners' principal axes), with z along the longest side.
struct HullShape {
  ConvexHull hull;              // corners in S
  Eigen::Isometry3d X_MS;       // S in the mesh's frame
  Eigen::Vector3d half_size_m;  // of the box
  double radius_m = 0.0;        // of a capsule about z that contains the hull
  double half_length_m = 0.0;   // half its axis

  // Neighbors of each corner along edges, corner by corner.
  std::vector<std::uint32_t> neighbors;
  std::vector<std::uint32_t> neighbors_end;  // end of each corner's neighbors

  // Returns the largest n . x of all corners; n in S.
  [[nodiscard]] double support(const Eigen::Vector3d& n_S) const;
  // Walks uphill along edges to the corner with the largest n . x. May end at its neighbor if faces
  // are flat except for rounding.
  [[nodiscard]] std::uint32_t uphill(const Eigen::Vector3d& n_S, std::uint32_t from) const;
};

[[nodiscard]] HullShape fit_hull(const ConvexHull& hull_M);

}  // namespace armloom
