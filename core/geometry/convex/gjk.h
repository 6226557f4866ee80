#pragma once

#include <optional>

#include "core/geometry/convex/convex_shape.h"

namespace armloom {

// A distance is known that is less than this too small.
inline constexpr double kGjkSettled_m = 1e-7;

// Gilbert, Johnson and Keerthi's algorithm: the point nearest to the origin of the difference of
// the shapes, whose direction parts them. Of round shapes the axes, of which the radii are taken
// off. The distance, or at least enough_m: the gap between two planes that hold the shapes apart,
// which is proven by all of their corners; zero where they share a point. Nothing where it is not
// settled, as with rims or for rounding: exact_distance.h settles that. Allocates nothing; any
// thread.
[[nodiscard]] std::optional<Separation> gjk(const ConvexShape& a, const PlacedConvexShape& at_a,
                                            const ConvexShape& b, const PlacedConvexShape& at_b,
                                            double enough_m);

}  // namespace armloom
