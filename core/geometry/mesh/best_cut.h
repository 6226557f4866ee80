#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <vector>

namespace armloom {

using Points = std::vector<Eigen::Vector3d>;

// Convex polygons, corner after corner; the i-th ends before ends[i].
struct Polygons {
  Points corners;
  std::vector<std::size_t> ends;
};

// A plane across an axis.
struct Cut {
  Eigen::Index axis = 0;
  double at = 0.0;
  double volume_m3 = std::numeric_limits<double>::infinity();  // of both sides, estimated
};

// The cut that leaves the smallest hulls on both of its sides, as far as some trials show.
[[nodiscard]] Cut best_cut(const Polygons& surface);

// What lies at sign * (x - cut.at) >= 0 along the cut's axis.
[[nodiscard]] Polygons clipped(const Polygons& polygons, const Cut& cut, double sign);

}  // namespace armloom
