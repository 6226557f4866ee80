#pragma once

#include <optional>

#include "core/geometry/convex/convex_shape.h"

namespace armloom {

// A distance is settled if it is less than this below the true distance.
inline constexpr double kGjkSettled_m = 1e-7;

// Algorithm of Gilbert, Johnson and Keerthi: finds the point nearest to the origin of the shapes'
// difference; its direction separates them. Round shapes are replaced by their axes, and the radii
// subtracted. Returns the gap between two separating planes, proven by all corners: the settled
// distance, or at least enough_m; zero if the shapes share a point. Returns nullopt if not settled,
// because of curved rims or rounding: use exact_distance.h then. Allocates nothing; thread-safe.
[[nodiscard]] std::optional<Separation> gjk(const ConvexShape& a, const PlacedConvexShape& at_a,
                                            const ConvexShape& b, const PlacedConvexShape& at_b,
                                            double enough_m);

}  // namespace armloom
