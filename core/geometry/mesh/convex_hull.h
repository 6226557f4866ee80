#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <tl/expected.hpp>
#include <vector>

namespace armloom {

struct ConvexHull {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> faces;  // counter-clockwise from outside, closed
};

// Points within kFlat_m of a plane have no volume: each becomes a cube of this side, so that the
// hull is slightly too large, never too small.
inline constexpr double kFlat_m = 2e-4;
// Hulls with more vertices are replaced by a simpler polytope around them that touches them in 162
// directions (for a sphere at most 1.5 % of the radius too large).
inline constexpr std::size_t kMaxHullVertices = 400;
// No point lies farther than this outside a face (checked for every point).
inline constexpr double kHullTolerance_m = 1e-6;

// Returns the hull of the points by qhull, or qhull's error, or that the tolerance is missed.
// Precondition: at least one point, all finite.
[[nodiscard]] tl::expected<ConvexHull, std::string> convex_hull(
    const std::vector<Eigen::Vector3d>& points);

[[nodiscard]] double volume_m3(const ConvexHull& hull);

}  // namespace armloom
