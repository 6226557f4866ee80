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

// The surfaces of closed meshes are queried only up to this distance, because larger queries cost
// milliseconds. If bodies are farther apart, body_distance() returns the larger of this value and
// the distance of their convex pieces.
inline constexpr double kSurfaceWithin_m = 0.05;

// Returns the distance of two bodies if it is below `limit_m`, else at least limit_m. Zero or
// negative in contact. Convex shapes are compared first (capsules, then GJK). If convex pieces of a
// closed mesh seem too close, the mesh's surface decides (solid.h).
// The result is never larger than the true distance. It is exact, except for pieces of meshes
// farther apart than kSurfaceWithin_m.
[[nodiscard]] double body_distance(const std::vector<ConvexShape>& shapes, const PlacedBody& a,
                                   const PlacedBody& b, double limit_m,
                                   const Roughness& of_surfaces = {});

// Returns true if balls inside both bodies prove that they are closer than limit_m
// (surely_closer_than, solid.h). Fast.
[[nodiscard]] bool bodies_surely_closer_than(const std::vector<ConvexShape>& shapes,
                                             const PlacedBody& a, const PlacedBody& b,
                                             double limit_m);

// Returns true if body_distance() is below limit_m. Faster than body_distance().
[[nodiscard]] bool bodies_closer_than(const std::vector<ConvexShape>& shapes, const PlacedBody& a,
                                      const PlacedBody& b, double limit_m);

// Returns how many of `limits_m` are kept: body_distance() is at least the limit. Faster than
// body_distance(), because surfaces decide each limit without computing a distance. Precondition:
// limits_m is ascending.
[[nodiscard]] std::size_t limits_kept(const std::vector<ConvexShape>& shapes, const PlacedBody& a,
                                      const PlacedBody& b, std::span<const double> limits_m);

}  // namespace armloom
