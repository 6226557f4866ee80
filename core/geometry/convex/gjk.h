#pragma once

#include <optional>

#include "core/geometry/convex/convex_shape.h"

namespace armloom {

// A proven gap is settled if it is less than this below the true distance.
inline constexpr double kGjkSettled_m = 1e-7;

// The algorithm of Gilbert, Johnson and Keerthi finds the point of the shapes' Minkowski difference
// that is nearest to the origin. The direction of this point separates the shapes. Round shapes are
// replaced by their axes, and their radii are subtracted.
//
// Returns the gap between two separating planes, proven by all corners of the shapes. The gap is
// settled or at least enough_m; it is zero if the shapes share a point. Returns nullopt if curved
// rims or rounding prevent a settled gap: use exact_distance.h then. Allocates nothing;
// thread-safe.
[[nodiscard]] std::optional<Separation> gjk(const ConvexShape& a, const PlacedConvexShape& at_a,
                                            const ConvexShape& b, const PlacedConvexShape& at_b,
                                            double enough_m);

}  // namespace armloom
