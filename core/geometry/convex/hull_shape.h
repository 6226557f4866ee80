#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/geometry/mesh/convex_hull.h"

namespace armloom {

// The convex hull of a mesh, or of a piece of one, in a frame S of its own, with what bounds it
// there: S stands in the middle of a box that holds the hull tightly (the better of the mesh's own
// axes and the principal axes of the hull's corners), its z along the longest side.
struct HullShape {
  ConvexHull hull;              // corners in S
  Eigen::Isometry3d X_MS;       // S in the mesh's frame
  Eigen::Vector3d half_size_m;  // of the box
  double radius_m = 0.0;        // of a capsule about z that contains the hull ...
  double half_length_m = 0.0;   // ... and half the length of its axis

  // The corner with the largest n . x; n in S.
  [[nodiscard]] const Eigen::Vector3d& farthest(const Eigen::Vector3d& n_S) const;
};

[[nodiscard]] HullShape fit_hull(const ConvexHull& hull_M);

}  // namespace armloom
