#pragma once

#include <Eigen/Geometry>
#include <cstdint>
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

  // Of each corner those it shares an edge with, one after the other.
  std::vector<std::uint32_t> neighbors;
  std::vector<std::uint32_t> neighbors_end;  // of each corner

  // The largest n . x of all corners; n in S.
  [[nodiscard]] double support(const Eigen::Vector3d& n_S) const;
  // The corner with it, most likely: uphill from another one along edges, which few corners are
  // looked at for. Where faces are flat but for rounding it may end beside it.
  [[nodiscard]] std::uint32_t uphill(const Eigen::Vector3d& n_S, std::uint32_t from) const;
};

[[nodiscard]] HullShape fit_hull(const ConvexHull& hull_M);

}  // namespace armloom
