#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <vector>

namespace armloom {

using Points = std::vector<Eigen::Vector3d>;

// Convex polygons, corner by corner; polygon i ends before ends[i].
struct Polygons {
  Points corners;
  std::vector<std::size_t> ends;
};

// A plane across an axis.
struct Cut {
  Eigen::Index axis = 0;
  double at = 0.0;
  double volume_m3 = std::numeric_limits<double>::infinity();  // estimated hulls of both sides
};

// Returns the tried cut with the smallest hulls on both sides.
[[nodiscard]] Cut best_cut(const Polygons& surface);

// Returns the part with sign * (x - cut.at) >= 0 along the cut's axis.
[[nodiscard]] Polygons clipped(const Polygons& polygons, const Cut& cut, double sign);

}  // namespace armloom
