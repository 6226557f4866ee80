#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "core/geometry/mesh/convex_hull.h"

namespace armloom {

// The convex hull of a mesh or of one of its convex pieces, with simple volumes around it. The
// origin of its frame S is the center of a tight box around the hull; z is along the box's longest
// side. The box is aligned with the mesh's axes or with the corners' principal axes.
struct HullShape {
  ConvexHull hull;              // corners in S
  Eigen::Isometry3d X_MS;       // pose of S in the mesh's frame M
  Eigen::Vector3d half_size_m;  // half the sides of the box
  double radius_m = 0.0;        // radius of a capsule about z that contains the hull
  double half_length_m = 0.0;   // half the length of the capsule's axis

  // The neighbors (along edges) of corner 0, then of corner 1, and so on.
  std::vector<std::uint32_t> neighbors;
  std::vector<std::uint32_t> neighbors_end;  // by corner: end of its part of `neighbors`

  // Returns the largest n . x of all corners x.
  [[nodiscard]] double support(const Eigen::Vector3d& n_S) const;
  // Returns the corner with the largest n . x. Walks uphill along edges, from the corner `from`. If
  // faces are flat except for rounding, the walk may end at a neighbor of this corner.
  [[nodiscard]] std::uint32_t uphill(const Eigen::Vector3d& n_S, std::uint32_t from) const;
};

[[nodiscard]] HullShape fit_hull(const ConvexHull& hull_M);

}  // namespace armloom
