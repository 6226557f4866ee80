#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/geometry/mesh/surface_tree.h"
#include "core/geometry/surface/inner_balls.h"
#include "core/geometry/surface/surface_descent.h"

namespace armloom {

// A body's true shape: all points within radius_m of the tree's triangles, and all points that
// these triangles enclose (enclosure.h). The tree holds:
// - closed mesh: its triangles as in the file
// - box, or hull of an open mesh: its faces
// - cylinder: a prism around it (kPrismOverestimate_m)
// - capsule or sphere: its axis, a triangle without area, with its radius
struct Solid {
  SurfaceTreePtr tree;
  // Pose of the tree's frame T in the part's frame P.
  Eigen::Isometry3d X_PT = Eigen::Isometry3d::Identity();
  double radius_m = 0.0;
  InnerBalls inner = {};  // balls inside it, in the tree's frame
};
using SolidPtr = std::shared_ptr<const Solid>;

struct PlacedSolid {
  const Solid& solid;
  Eigen::Isometry3d X_WT;
};

// Returns min(distance, limit_m) of two solids; zero if they touch, overlap or contain each other.
// The result is never larger than the true distance, because separating planes prove the distance
// of each pair of triangles (triangle_distance.h) and rounding is subtracted. In tests the result
// was less than 1e-9 m too small, plus what `rough` allows. Small limits are cheap. Never throws,
// allocates nothing; thread-safe.
[[nodiscard]] double solid_distance(const PlacedSolid& a, const PlacedSolid& b, double limit_m,
                                    const Roughness& rough = {});

// Returns true if the solids are closer than limit_m. Faster than solid_distance().
[[nodiscard]] bool closer_than(const PlacedSolid& a, const PlacedSolid& b, double limit_m);

// Returns true if balls inside the solids prove that these are closer than limit_m, as in most deep
// overlaps. False proves nothing.
[[nodiscard]] bool surely_closer_than(const PlacedSolid& a, const PlacedSolid& b, double limit_m);

// Returns the unit direction, in the world frame, from the nearest triangle of a to that of b.
// Returns nullopt if these touch. Along this direction, convex solids are apart by their whole
// distance (radii included).
[[nodiscard]] std::optional<Eigen::Vector3d> direction_apart(const PlacedSolid& a,
                                                             const PlacedSolid& b);

// Passes each pair of triangles that are closer than within_m (radii included) to `kept`; the
// triangles are passed without radii. Returns true if `kept` accepts all these pairs, and stops at
// the first rejected pair. Touching triangles are always rejected. Does not check if one solid is
// inside the other.
[[nodiscard]] bool surfaces_apart(const PlacedSolid& a, const PlacedSolid& b, double within_m,
                                  KeptApart& kept);

}  // namespace armloom
