#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/collision/scene/scene_bodies.h"

namespace armloom {

// A body somewhere in the world.
struct PlacedBody {
  const CollisionBody& body;
  Eigen::Isometry3d X_WP;
};

// Surfaces are asked no farther than this: beyond it the distance of pieces, or this one where that
// is smaller, is near enough, and a surface's would cost milliseconds.
inline constexpr double kSurfaceWithin_m = 0.05;

// The distance of two bodies where it is below `limit_m`, else at least limit_m; zero or negative
// in contact. Convex shapes answer first (capsules, then GJK); what pieces of a closed mesh call
// closer is decided by its surface (solid.h). Never larger than the true distance; exact but for
// pieces of meshes that are farther apart than kSurfaceWithin_m.
[[nodiscard]] double body_distance(const std::vector<ConvexShape>& shapes, const PlacedBody& a,
                                   const PlacedBody& b, double limit_m,
                                   const Roughness& of_surfaces = {});

// Whether balls prove it (surely_closer_than, solid.h): what is soon known.
[[nodiscard]] bool bodies_surely_closer_than(const std::vector<ConvexShape>& shapes,
                                             const PlacedBody& a, const PlacedBody& b,
                                             double limit_m);

// Whether body_distance() is below limit_m, found out sooner.
[[nodiscard]] bool bodies_closer_than(const std::vector<ConvexShape>& shapes, const PlacedBody& a,
                                      const PlacedBody& b, double limit_m);

// How many of these limits body_distance() is not below, found out sooner: of surfaces each limit
// is decided by itself, which takes a fraction of their distance. Precondition: ascending.
[[nodiscard]] std::size_t limits_kept(const std::vector<ConvexShape>& shapes, const PlacedBody& a,
                                      const PlacedBody& b, std::span<const double> limits_m);

}  // namespace armloom
