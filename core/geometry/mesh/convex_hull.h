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

// If all points lie within kFlat_m of a plane, each point is replaced by a cube with this side. So
// the hull has a volume; it is slightly too large, never too small.
inline constexpr double kFlat_m = 2e-4;
// A hull with more vertices is replaced by a simpler polytope around it, which touches it in 162
// directions. Around a sphere, this polytope is at most 1.5 % of the radius too large.
inline constexpr std::size_t kMaxHullVertices = 400;
// No point lies farther than this outside a face (checked for every point).
inline constexpr double kHullTolerance_m = 1e-6;

// Returns the hull of the points, computed by qhull. The error is qhull's, or it says that a point
// lies farther outside than kHullTolerance_m. Precondition: at least one point; all points are
// finite.
[[nodiscard]] tl::expected<ConvexHull, std::string> convex_hull(
    const std::vector<Eigen::Vector3d>& points);

[[nodiscard]] double volume_m3(const ConvexHull& hull);

}  // namespace armloom
