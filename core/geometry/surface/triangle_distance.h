#pragma once

#include <Eigen/Core>
#include <array>

namespace armloom {

using TrianglePoints = std::array<Eigen::Vector3d, 3>;

// min(distance, limit_m) of two triangles, or of what is left of degenerate ones (segments,
// points); zero where they touch. Never larger than the true distance but by rounding (some 1e-16
// of the coordinates): the nearest points of edges and faces only give directions, and what is
// returned is the gap between two planes across one of them that hold the triangles apart. Smaller
// than the true one by less than 1e-9 m in all that was tried (test/soundness).
[[nodiscard]] double triangle_distance(const TrianglePoints& a, const TrianglePoints& b,
                                       double limit_m);
// The same with that direction, of unit length, from a to b; zero where they touch.
struct TriangleGap {
  double distance_m;
  Eigen::Vector3d n;
};
[[nodiscard]] TriangleGap triangle_gap(const TrianglePoints& a, const TrianglePoints& b,
                                       double limit_m);

}  // namespace armloom
