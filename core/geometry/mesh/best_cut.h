#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <vector>

namespace armloom {

using Points = std::vector<Eigen::Vector3d>;

// Convex polygons. `corners` has the corners of polygon 0, then of polygon 1, and so on; those of
// polygon i end before index ends[i].
struct Polygons {
  Points corners;
  std::vector<std::size_t> ends;
};

// A plane perpendicular to an axis, at position `at` (m) on this axis.
struct Cut {
  Eigen::Index axis = 0;
  double at = 0.0;
  // Estimated volume of both sides' hulls.
  double volume_m3 = std::numeric_limits<double>::infinity();
};

// Tries some cuts. Returns the cut with the smallest estimated volume of both sides' hulls.
[[nodiscard]] Cut best_cut(const Polygons& surface);

// Returns the part of the polygons with sign * (x - cut.at) >= 0, where x is the coordinate along
// the cut's axis.
[[nodiscard]] Polygons clipped(const Polygons& polygons, const Cut& cut, double sign);

}  // namespace armloom
