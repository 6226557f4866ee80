#pragma once

#include <vector>

#include "core/geometry/capsule/capsule_fit.h"
#include "core/geometry/convex/convex_shape.h"

namespace armloom {

// One or two capsules that enclose all shapes of a body.
struct LinkCapsules {
  std::vector<LinkCapsule> capsules;  // each shape lies completely in one capsule
  // Largest distance of the capsules' surface from the shapes, at least 0. Slightly too small,
  // because it is sampled at some hundred points.
  double overestimate_m = 0.0;
};

// Returns balls whose convex hull contains the shape, in the body's frame:
// - round shape: both ends
// - box, hull: the corners
// - cylinder: 64 corners around each end, which lie up to 0.12 % of the radius outside
[[nodiscard]] std::vector<Ball> extreme_balls(const ConvexShape& shape);

// Returns true if the shape lies completely in the capsule. A true answer is always right. The
// answer may be false although the shape fits, but only within rounding and 0.12 % of a cylinder's
// radius.
[[nodiscard]] bool contains(const LinkCapsule& capsule, const ConvexShape& shape);

// Returns one or two small capsules that enclose the shapes. If a round shape contains all others,
// its own capsule is returned. Two capsules are returned if
// - their total volume is below kTwoVolume of the single capsule's, or
// - their largest distance from the shapes is below kTwoOverestimate of the single capsule's and
//   smaller by at least kTwoGain_m, at no larger total volume.
// Up to 8 shapes are split between two capsules in every possible way. More shapes are split only
// in their order along an axis of the body.
// A single shape is not cut, because meshes come in convex pieces
// (core/geometry/mesh/convex_pieces.h). Throws std::logic_error if a shape is in no capsule (a
// bug). Deterministic; takes about a millisecond. Precondition: at least one shape.
inline constexpr double kTwoVolume = 0.75;
inline constexpr double kTwoOverestimate = 0.75;
inline constexpr double kTwoGain_m = 0.005;
[[nodiscard]] LinkCapsules fit_capsules(const std::vector<ConvexShape>& shapes);

}  // namespace armloom
