#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>

#include "core/geometry/convex/convex_shape.h"

namespace armloom {

// FCL geometry of one convex shape. FCL is included only behind this header, so that its headers
// are compiled once. Immutable; concurrent queries on the same geometry are safe.
class ExactGeometry;
[[nodiscard]] std::shared_ptr<const ExactGeometry> make_exact_geometry(const ConvexShape& body);

// Returns the distance (m) of two convex shapes at the poses of their shape frames. A mesh is
// represented by a piece or its hull (surfaces: core/geometry/surface). Zero in contact, or if no
// distance can be proven. Allocates inside FCL.
//
// Never larger than the true distance; measured less than 2e-7 below it, except half a millimeter
// for one random pair in 60,000. FCL's GJK stops early and returns up to 0.8 mm too much (at
// distance_tolerance 1e-6), so its nearest points only give a direction. The result is the gap
// between two planes across that direction that separate the bodies, which is a proof.
[[nodiscard]] double exact_distance(const ConvexShape& a, const Eigen::Isometry3d& X_WA,
                                    const ConvexShape& b, const Eigen::Isometry3d& X_WB);
// Returns the distance and its direction, or nullopt if exact_distance() is zero.
[[nodiscard]] std::optional<Separation> exact_separation(const ConvexShape& a,
                                                         const Eigen::Isometry3d& X_WA,
                                                         const ConvexShape& b,
                                                         const Eigen::Isometry3d& X_WB);

}  // namespace armloom
