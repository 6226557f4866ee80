#include "core/geometry/mesh/best_cut.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/geometry/mesh/convex_hull.h"
#include "core/geometry/spread_directions.h"

namespace armloom {
namespace {

constexpr int kOffsets = 7;        // cuts tried along an axis before refinement
constexpr int kRefinements = 5;    // each halves the distance to the next cut tried
constexpr double kBeside = 1e-5;   // of the extent: distance of a cut from a corner
constexpr int kEstimateFrom = 80;  // directions whose farthest points represent a side

double estimated_volume(const Points& points) {
  static const Points kDirections = spread_directions(kEstimateFrom);
  if (points.empty()) return 0.0;
  Points farthest;
  for (const Eigen::Vector3d& n : kDirections) {
    const Eigen::Vector3d* best = &points.front();
    double reach = n.dot(*best);
    for (const Eigen::Vector3d& p : points) {
      const double r = n.dot(p);
      if (r <= reach) continue;
      reach = r;
      best = &p;
    }
    farthest.push_back(*best);
  }
  const auto hull = convex_hull(farthest);
  return hull ? volume_m3(*hull) : std::numeric_limits<double>::infinity();
}

struct Estimated {
  const Polygons& surface;
  Points corners;
};

Estimated without_doubles(const Polygons& surface) {
  Estimated estimated{surface, surface.corners};
  Points& corners = estimated.corners;
  std::sort(corners.begin(), corners.end(), [](const auto& a, const auto& b) {
    return std::tuple(a.x(), a.y(), a.z()) < std::tuple(b.x(), b.y(), b.z());
  });
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return estimated;
}

// Estimates the volume of both sides' hulls, in m^3.
double estimated_volume(const Estimated& cell, Eigen::Index axis, double at) {
  Points low;
  Points high;
  for (const Eigen::Vector3d& p : cell.corners) (p[axis] < at ? low : high).push_back(p);
  std::size_t begin = 0;
  for (const std::size_t end : cell.surface.ends) {
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3d& p = cell.surface.corners[i];
      const Eigen::Vector3d& next = cell.surface.corners[i + 1 < end ? i + 1 : begin];
      // Uses each edge only once: the neighbor triangle has the edge reversed.
      if (!(p[axis] < at && next[axis] > at)) continue;
      low.push_back(p + (at - p[axis]) / (next[axis] - p[axis]) * (next - p));
      high.push_back(low.back());
    }
    begin = end;
  }
  return estimated_volume(low) + estimated_volume(high);
}

void try_cuts(const Estimated& cell, Eigen::Index axis, const std::vector<double>& places,
              Cut& best) {
  for (const double at : places) {
    const double volume = estimated_volume(cell, axis, at);
    if (volume < best.volume_m3) best = {axis, at, volume};
  }
}

// Returns the positions just before and behind the corner nearest to the cut, because cuts gain
// most at concave edges.
std::vector<double> beside_corner(const Points& corners, const Cut& cut, double extent) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& p : corners) {
    if (std::abs(p[cut.axis] - cut.at) < std::abs(nearest - cut.at)) nearest = p[cut.axis];
  }
  return {nearest - kBeside * extent, nearest + kBeside * extent};
}

}  // namespace

Cut best_cut(const Polygons& surface) {
  const Estimated cell = without_doubles(surface);
  Eigen::AlignedBox3d bounds;
  for (const Eigen::Vector3d& p : cell.corners) bounds.extend(p);
  Cut best;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const double spacing = bounds.sizes()[axis] / (kOffsets + 1);
    std::vector<double> places;
    for (int i = 1; i <= kOffsets; ++i) places.push_back(bounds.min()[axis] + i * spacing);
    try_cuts(cell, axis, places, best);
  }
  double step = bounds.sizes()[best.axis] / (kOffsets + 1);
  for (int i = 0; i < kRefinements; ++i) {
    step *= 0.5;
    try_cuts(cell, best.axis, {best.at - step, best.at + step}, best);
  }
  try_cuts(cell, best.axis, beside_corner(cell.corners, best, bounds.sizes()[best.axis]), best);
  return best;
}

// Algorithm of Sutherland and Hodgman.
Polygons clipped(const Polygons& polygons, const Cut& cut, double sign) {
  const auto [axis, at, volume_m3] = cut;
  Polygons kept;
  kept.corners.reserve(polygons.corners.size());
  std::size_t begin = 0;
  for (const std::size_t end : polygons.ends) {
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3d& p = polygons.corners[i];
      const Eigen::Vector3d& next = polygons.corners[i + 1 < end ? i + 1 : begin];
      const double d = sign * (p[axis] - at);
      const double d_next = sign * (next[axis] - at);
      if (d >= 0.0) kept.corners.push_back(p);
      if ((d > 0.0 && d_next < 0.0) || (d < 0.0 && d_next > 0.0)) {
        Eigen::Vector3d crossing = p + d / (d - d_next) * (next - p);
        crossing[axis] = at;
        kept.corners.push_back(crossing);
      }
    }
    if (kept.corners.size() > (kept.ends.empty() ? 0 : kept.ends.back())) {
      kept.ends.push_back(kept.corners.size());
    }
    begin = end;
  }
  return kept;
}

}  // namespace armloom
