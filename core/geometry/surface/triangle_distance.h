#pragma once

#include <Eigen/Core>
#include <array>

namespace armloom {

using TrianglePoints = std::array<Eigen::Vector3d, 3>;

// Returns min(distance, limit_m) of two triangles, degenerate or not; zero if they touch. The
// result is the gap between two separating planes, so it exceeds the true distance only by rounding
// (about 1e-16 of the coordinates). In all tests (test/soundness) it was less than 1e-9 m too
// small.
[[nodiscard]] double triangle_distance(const TrianglePoints& a, const TrianglePoints& b,
                                       double limit_m);
// A distance and its unit direction from a to b. The distance is zero in contact.
struct TriangleGap {
  double distance_m;
  Eigen::Vector3d n;
};
[[nodiscard]] TriangleGap triangle_gap(const TrianglePoints& a, const TrianglePoints& b,
                                       double limit_m);

}  // namespace armloom
