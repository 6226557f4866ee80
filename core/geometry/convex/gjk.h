#pragma once

#include <Eigen/Core>

#include "core/geometry/convex/convex_shape.h"

namespace armloom {

// What is known of two convex shapes, however the search ended.
struct GjkResult {
  // Between two planes across n that hold the shapes apart: proven by their support in that
  // direction. Not positive: nothing is proven.
  Separation proven;
  // proven is enough, or less than kGjkSettled_m below the distance; or zero, as they share a point.
  // Else it says nothing of how close they are.
  bool settled = false;
};

inline constexpr double kGjkSettled_m = 1e-7;

// Gilbert, Johnson and Keerthi's algorithm: the point nearest to the origin of the difference of the
// shapes, whose direction parts them. Of round shapes the axes, of which the radii are taken off. Ends
// as soon as enough_m is proven. The fast way to what exact_distance.h says: most of what FCL takes
// is copies, and corners of which it keeps a list. Allocates nothing; any thread.
[[nodiscard]] GjkResult gjk(const ConvexShape& a, const PlacedConvexShape& at_a,
                            const ConvexShape& b, const PlacedConvexShape& at_b, double enough_m);

}  // namespace armloom
