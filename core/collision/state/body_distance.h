#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/collision/scene/scene_bodies.h"

namespace armloom {

// A body at a pose in the world.
struct PlacedBody {
  const CollisionBody& body;
  Eigen::Isometry3d X_WP;
};

// Surfaces are queried only up to this distance, because a surface distance costs milliseconds.
// Farther bodies get the distance of their pieces or, if the pieces are closer, kSurfaceWithin_m.
inline constexpr double kSurfaceWithin_m = 0.05;

// Returns the distance of two bodies if it is below `limit_m`, else at least limit_m; zero or
// negative in contact. Convex shapes answer first (capsules, then GJK). If pieces of a closed mesh
// seem closer, its surface decides (solid.h). Never larger than the true distance. Exact, except
// for pieces of meshes that are farther apart than kSurfaceWithin_m.
[[nodiscard]] double body_distance(const std::vector<ConvexShape>& shapes, const PlacedBody& a,
                                   const PlacedBody& b, double limit_m,
                                   const Roughness& of_surfaces = {});

// Returns true if inner balls prove that the bodies are closer (surely_closer_than, solid.h). Fast.
[[nodiscard]] bool bodies_surely_closer_than(const std::vector<ConvexShape>& shapes,
                                             const PlacedBody& a, const PlacedBody& b,
                                             double limit_m);

// Returns true if body_distance() is below limit_m, but faster.
[[nodiscard]] bool bodies_closer_than(const std::vector<ConvexShape>& shapes, const PlacedBody& a,
                                      const PlacedBody& b, double limit_m);

// Returns how many of these limits body_distance() reaches, but faster: surfaces decide each limit
// by itself, which takes a fraction of the time of a distance. Precondition: ascending.
[[nodiscard]] std::size_t limits_kept(const std::vector<ConvexShape>& shapes, const PlacedBody& a,
                                      const PlacedBody& b, std::span<const double> limits_m);

}  // namespace armloom
