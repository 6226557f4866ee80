#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/collision/scene/scene_bodies.h"

namespace armloom {

struct PlacedBody {
  const CollisionBody& body;
  Eigen::Isometry3d X_WP;
};

// Surfaces are queried only up to this distance, because they cost milliseconds. Farther bodies get
// the larger of this and the distance of their pieces.
inline constexpr double kSurfaceWithin_m = 0.05;

// Returns the distance of two bodies if below `limit_m`, else at least limit_m; zero or negative in
// contact. Convex shapes come first (capsules, then GJK); if pieces of a closed mesh seem closer,
// its surface decides (solid.h). Never larger than the true distance; exact except for pieces of
// meshes farther apart than kSurfaceWithin_m.
[[nodiscard]] double body_distance(const std::vector<ConvexShape>& shapes, const PlacedBody& a,
                                   const PlacedBody& b, double limit_m,
                                   const Roughness& of_surfaces = {});

// Returns true if inner balls prove it (surely_closer_than, solid.h); fast.
[[nodiscard]] bool bodies_surely_closer_than(const std::vector<ConvexShape>& shapes,
                                             const PlacedBody& a, const PlacedBody& b,
                                             double limit_m);

// Returns true if body_distance() is below limit_m; faster.
[[nodiscard]] bool bodies_closer_than(const std::vector<ConvexShape>& shapes, const PlacedBody& a,
                                      const PlacedBody& b, double limit_m);

// Returns how many of these limits body_distance() reaches; faster, because surfaces decide each
// limit without computing a distance. Precondition: ascending.
[[nodiscard]] std::size_t limits_kept(const std::vector<ConvexShape>& shapes, const PlacedBody& a,
                                      const PlacedBody& b, std::span<const double> limits_m);

}  // namespace armloom
