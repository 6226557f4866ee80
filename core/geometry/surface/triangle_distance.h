#pragma once

#include <Eigen/Core>
#include <array>

namespace armloom {

using TrianglePoints = std::array<Eigen::Vector3d, 3>;

// Returns min(distance, limit_m) of two triangles, degenerate or not; zero if they touch. Never
// larger than the true distance except by rounding (about 1e-16 of the coordinates): nearest points
// only give directions, and the result is the gap between two separating planes. Less than 1e-9 m
// too small in all tests (test/soundness).
[[nodiscard]] double triangle_distance(const TrianglePoints& a, const TrianglePoints& b,
                                       double limit_m);
// A distance and its unit direction from a to b (zero in contact).
struct TriangleGap {
  double distance_m;
  Eigen::Vector3d n;
};
[[nodiscard]] TriangleGap triangle_gap(const TrianglePoints& a, const TrianglePoints& b,
                                       double limit_m);

}  // namespace armloom
