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

// A body's true shape: all points within radius_m of the tree's triangles, and all that they
// enclose (encloses()).
// - closed mesh: its triangles as in the file
// - box, or hull of an open mesh: its faces
// - cylinder: a prism around it (kPrismOverestimate_m)
// - capsule or sphere: its axis, a triangle without area, with its radius
struct Solid {
  SurfaceTreePtr tree;
  Eigen::Isometry3d X_PT = Eigen::Isometry3d::Identity();  // the tree's frame in the part's frame P
  double radius_m = 0.0;
  InnerBalls inner = {};  // balls inside it, in the tree's frame
};
using SolidPtr = std::shared_ptr<const Solid>;

struct PlacedSolid {
  const Solid& solid;
  Eigen::Isometry3d X_WT;
};

// Returns min(distance, limit_m) of two solids; zero if they touch, overlap or contain each other.
// Never larger than the true distance: each pair of triangles is proven apart
// (triangle_distance.h), minus rounding. Measured less than 1e-9 m below it, plus what `rough`
// allows. Small limits are cheap. Never throws, allocates nothing; thread-safe.
[[nodiscard]] double solid_distance(const PlacedSolid& a, const PlacedSolid& b, double limit_m,
                                    const Roughness& rough = {});

// Returns true if closer than limit_m. Faster than the distance.
[[nodiscard]] bool closer_than(const PlacedSolid& a, const PlacedSolid& b, double limit_m);

// Returns true if inner balls prove closer_than(), as in most deep overlaps.
[[nodiscard]] bool surely_closer_than(const PlacedSolid& a, const PlacedSolid& b, double limit_m);

// Returns the unit direction from a to b of their nearest triangles, in the world, or nullopt if
// they touch. Along it, convex solids are apart by their whole distance (radii included).
[[nodiscard]] std::optional<Eigen::Vector3d> direction_apart(const PlacedSolid& a,
                                                             const PlacedSolid& b);

// Returns true if `kept` accepts every two triangles (passed without radii) that are closer than
// within_m, radii included. Stops at the first rejected. Does not check if one solid is inside the
// other.
[[nodiscard]] bool surfaces_apart(const PlacedSolid& a, const PlacedSolid& b, double within_m,
                                  KeptApart& kept);

}  // namespace armloom
