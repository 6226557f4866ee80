#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>

#include "core/geometry/convex/convex_shape.h"

namespace armloom {

// FCL geometry of one convex shape. In this folder only exact_distance.cc includes FCL, which is
// slow to compile. Immutable; concurrent queries are safe.
class ExactGeometry;
[[nodiscard]] std::shared_ptr<const ExactGeometry> make_exact_geometry(const ConvexShape& body);

// Returns the distance (m) of two convex shapes (of a mesh: a piece or its hull) at the poses of
// their shape frames; zero in contact, or if no distance can be proven. FCL allocates memory.
//
// The result is never larger than the true distance. In tests it was less than 2e-7 m too small,
// except for one random pair in 60,000 (half a millimeter). FCL's GJK may stop early and return up
// to 0.8 mm too much (at distance_tolerance 1e-6). So only the direction of FCL's nearest points is
// used: the gap between two planes across this direction proves the distance.
[[nodiscard]] double exact_distance(const ConvexShape& a, const Eigen::Isometry3d& X_WA,
                                    const ConvexShape& b, const Eigen::Isometry3d& X_WB);
// Returns the distance with its direction, or nullopt if zero.
[[nodiscard]] std::optional<Separation> exact_separation(const ConvexShape& a,
                                                         const Eigen::Isometry3d& X_WA,
                                                         const ConvexShape& b,
                                                         const Eigen::Isometry3d& X_WB);

}  // namespace armloom
