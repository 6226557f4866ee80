#pragma once

#include <vector>

#include "core/geometry/capsule/capsule_fit.h"
#include "core/geometry/convex/convex_shape.h"

namespace armloom {

// One or two capsules that enclose all shapes of a body.
struct LinkCapsules {
  std::vector<LinkCapsule> capsules;  // each shape lies completely in one capsule
  double overestimate_m = 0.0;  // how far their surface stands off the shapes at most, at least 0:
                                // slightly too small (some hundred samples)
};

// Returns balls that span a shape, in the body's frame: both ends of a round shape, the corners of
// a box or hull, 64 corners around each end of a cylinder (0.12 % of the radius outside).
[[nodiscard]] std::vector<Ball> extreme_balls(const ConvexShape& shape);

// Returns true if the shape lies completely in the capsule. Never wrongly true; wrongly false only
// within rounding and 0.12 % of a cylinder's radius.
[[nodiscard]] bool contains(const LinkCapsule& capsule, const ConvexShape& shape);

// Returns small capsules around the shapes. A round shape that contains all others yields its own
// capsule. There are two capsules if
// - their volume together is below kTwoVolume of the single capsule, or
// - they stand off less than kTwoOverestimate as far, by at least kTwoGain_m, with no larger
//   volume.
// The two are the best of all partitions for up to 8 shapes, else of those across a principal axis.
// A single shape is not cut: meshes come in pieces (core/geometry/mesh/convex_pieces.h). Throws
// std::logic_error if a shape lies in neither. Deterministic; takes about a millisecond.
// Precondition: at least one shape.
inline constexpr double kTwoVolume = 0.75;
inline constexpr double kTwoOverestimate = 0.75;
inline constexpr double kTwoGain_m = 0.005;
[[nodiscard]] LinkCapsules fit_capsules(const std::vector<ConvexShape>& shapes);

}  // namespace armloom
