#pragma once

#include <cstddef>
#include <vector>

#include "core/collision/scene/scene_bodies.h"

namespace armloom {

// A part somewhere in the world.
struct PlacedPart {
  const Part& part;
  Eigen::Isometry3d X_WP;
};

// Surfaces are asked no farther than this: beyond it the distance of pieces, or this one where that
// is smaller, is near enough, and a surface's would cost milliseconds.
inline constexpr double kSurfaceWithin_m = 0.05;

// The distance of two parts where it is below `limit_m`, else at least limit_m; zero or negative in
// contact. Convex bodies answer first (capsules, then GJK); what pieces of a closed mesh call
// closer is decided by its surface (solid.h). Never larger than the true distance; exact but for
// pieces of meshes that are farther apart than kSurfaceWithin_m.
[[nodiscard]] double part_distance(const std::vector<ConvexShape>& bodies, const PlacedPart& a,
                                   const PlacedPart& b, double limit_m);
[[nodiscard]] double part_distance(const PlanningScene::Bodies& bodies, std::size_t part_a,
                                   const Eigen::Isometry3d& X_WA, std::size_t part_b,
                                   const Eigen::Isometry3d& X_WB, double limit_m);

// Whether balls prove it (surely_closer_than, solid.h): what is soon known.
[[nodiscard]] bool parts_surely_closer_than(const std::vector<ConvexShape>& bodies,
                                            const PlacedPart& a, const PlacedPart& b,
                                            double limit_m);

// Whether part_distance() is below limit_m, found out sooner.
[[nodiscard]] bool parts_closer_than(const std::vector<ConvexShape>& bodies, const PlacedPart& a,
                                     const PlacedPart& b, double limit_m);

}  // namespace armloom
