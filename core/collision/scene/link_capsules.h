#pragma once

#include <vector>

#include "core/geometry/capsule/capsule_fit.h"
#include "core/geometry/convex/convex_shape.h"

namespace armloom {

// One or two capsules in place of all shapes of a body.
struct LinkCapsules {
  std::vector<LinkCapsule> capsules;  // each shape lies wholly inside one of them
  double overestimate_m = 0.0;  // how far their surface stands off the shapes at most: measured at
                                // some hundred points, so a little too small, and at least 0
};

// The balls that span a shape, in the body's frame: the two end balls of a round shape, the corners
// of a box or hull, 64 corners around each end of a cylinder (0.12 % of the radius outside).
[[nodiscard]] std::vector<Ball> extreme_balls(const ConvexShape& shape);

// Whether the shape lies wholly in the capsule: never a wrong yes; a wrong no only within rounding,
// and within 0.12 % of a cylinder's radius.
[[nodiscard]] bool contains(const LinkCapsule& capsule, const ConvexShape& shape);

// Capsules around the shapes, small in volume. A round shape that holds all others gives exactly
// its own capsule. There are two when they have less than kTwoVolume of the one's volume together;
// or when they stand off less than kTwoOverestimate as far, kTwoGain_m at least, and are not larger
// together. The two are the best partition of the shapes: of all for up to 8 shapes, else of those
// across a principal axis. A single shape is not cut: meshes come in pieces
// (core/geometry/mesh/convex_pieces.h). Every shape is checked: std::logic_error if one lies in
// neither. Deterministic; about a millisecond. Precondition: at least one shape.
inline constexpr double kTwoVolume = 0.75;
inline constexpr double kTwoOverestimate = 0.75;
inline constexpr double kTwoGain_m = 0.005;
[[nodiscard]] LinkCapsules fit_capsules(const std::vector<ConvexShape>& shapes);

}  // namespace armloom
