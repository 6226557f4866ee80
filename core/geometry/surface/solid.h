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

// What a body really is, as a surface: all points within radius_m of the tree's triangles, and all
// that they enclose (encloses()). A closed mesh is its triangles as the file has them; a box or the
// hull of an open mesh its faces; a cylinder a prism around it (kPrismOverestimate_m); a capsule or
// sphere its axis, a triangle without area, with its radius.
struct Solid {
  SurfaceTreePtr tree;
  Eigen::Isometry3d X_PT = Eigen::Isometry3d::Identity();  // of the tree's frame, in the part's P
  double radius_m = 0.0;
  InnerBalls inner = {};  // that lie in it, in the tree's frame
};
using SolidPtr = std::shared_ptr<const Solid>;

// A solid whose tree stands somewhere in the world.
struct PlacedSolid {
  const Solid& solid;
  Eigen::Isometry3d X_WT;
};

// min(distance, limit_m) of two solids; zero where they touch, overlap or one is inside of the
// other. Never larger than the true distance (each pair of triangles is proven apart,
// triangle_distance.h; the rounding of the tree's boxes is taken off); measured less than 1e-9 m
// below it, and what is allowed. What lies farther than limit_m is passed over: cheap when limit_m
// is small. Throws nothing, allocates nothing; any thread.
[[nodiscard]] double solid_distance(const PlacedSolid& a, const PlacedSolid& b, double limit_m,
                                    const Roughness& rough = {});

// Whether they are closer than limit_m, which is found out sooner than how close.
[[nodiscard]] bool closer_than(const PlacedSolid& a, const PlacedSolid& b, double limit_m);

// Whether balls inside of them prove that they are closer than limit_m: most that overlap deeply.
[[nodiscard]] bool surely_closer_than(const PlacedSolid& a, const PlacedSolid& b, double limit_m);

// The direction from a to b of their nearest triangles, of unit length, in the world; nothing where
// two touch. Convex solids are as far apart along it as they are (radii included).
[[nodiscard]] std::optional<Eigen::Vector3d> direction_apart(const PlacedSolid& a,
                                                             const PlacedSolid& b);

// Whether every two triangles (with the radii) that are closer than within_m are kept apart, which
// tells of triangles without radii. Ends with the first that are not. Whether one solid is inside
// of the other is not asked.
[[nodiscard]] bool surfaces_apart(const PlacedSolid& a, const PlacedSolid& b, double within_m,
                                  KeptApart& kept);

}  // namespace armloom
