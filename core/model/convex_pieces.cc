#include "core/model/convex_pieces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>

namespace armloom {
namespace {

using Points = std::vector<Eigen::Vector3d>;

constexpr int kOffsets = 7;        // cuts tried along an axis, before the best is refined
constexpr int kRefinements = 5;    // each halves the distance to the next cut tried
constexpr double kBeside = 1e-5;   // of the extent: a cut passes a face at this distance
constexpr int kEstimateFrom = 80;  // directions whose farthest points stand for a side
constexpr int kEscapeDirections = 40;

// Convex polygons, corner after corner; the i-th ends before ends[i].
struct Polygons {
  Points corners;
  std::vector<std::size_t> ends;
};

// A box of space and what lies of the surface in it.
struct Cell3 {
  Eigen::AlignedBox3d box;
  Polygons surface;
  ConvexHull hull;
  double volume_m3 = 0.0;
};

struct Cut {
  Eigen::Index axis = 0;
  double at = 0.0;
  double volume_m3 = std::numeric_limits<double>::infinity();  // of both sides, estimated
};

Points unit_spread(int count) {
  const double turn = std::numbers::pi * (3.0 - std::sqrt(5.0));
  Points directions;
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / count;
    const double r = std::sqrt(1.0 - z * z);
    directions.emplace_back(r * std::cos(turn * i), r * std::sin(turn * i), z);
  }
  return directions;
}

// The part with sign * (x - at) >= 0 along the axis (Sutherland and Hodgman).
Polygons clipped(const Polygons& polygons, Eigen::Index axis, double at, double sign) {
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

double estimated_volume(const Points& points) {
  static const Points kDirections = unit_spread(kEstimateFrom);
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

// Whether the ray may hit the triangle; a doubt is a yes.
bool may_hit(const Eigen::Vector3d& from, const Eigen::Vector3d& direction,
             const std::array<Eigen::Vector3d, 3>& t) {
  constexpr double kDoubt = 1e-10;
  bool any_positive = false;
  bool any_negative = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d a = t[i] - from;
    const Eigen::Vector3d b = t[(i + 1) % 3] - from;
    const double side = direction.dot(a.cross(b));
    const double size = kDoubt * (a.norm() * b.norm() + kDoubt);
    any_positive = any_positive || side > size;
    any_negative = any_negative || side < -size;
  }
  if (any_positive && any_negative) return false;
  // The line hits; behind the origin when all corners are.
  return std::any_of(t.begin(), t.end(), [&](const Eigen::Vector3d& p) {
    return direction.dot(p - from) > -kDoubt * ((p - from).norm() + kDoubt);
  });
}

// Whether some ray leaves the point without hitting the surface: then nothing encloses it.
bool escapes(const Eigen::Vector3d& p, const MeshData& mesh) {
  static const Points kDirections = unit_spread(kEscapeDirections);
  return std::any_of(kDirections.begin(), kDirections.end(), [&](const Eigen::Vector3d& n) {
    return std::none_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
      return may_hit(p, n, {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
    });
  });
}

// The corners of the box that the mesh may enclose.
Points enclosed_corners(const Eigen::AlignedBox3d& box, const MeshData& mesh) {
  Points corners;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d corner((i & 1 ? box.max() : box.min()).x(),
                                 (i & 2 ? box.max() : box.min()).y(),
                                 (i & 4 ? box.max() : box.min()).z());
    if (corner.allFinite() && !escapes(corner, mesh)) corners.push_back(corner);
  }
  return corners;
}

// A surface, and its corners once each.
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

// Of the hulls of what lies on either side.
double estimated_volume(const Estimated& cell, Eigen::Index axis, double at) {
  Points low;
  Points high;
  for (const Eigen::Vector3d& p : cell.corners) (p[axis] < at ? low : high).push_back(p);
  std::size_t begin = 0;
  for (const std::size_t end : cell.surface.ends) {
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3d& p = cell.surface.corners[i];
      const Eigen::Vector3d& next = cell.surface.corners[i + 1 < end ? i + 1 : begin];
      if (!(p[axis] < at && next[axis] > at)) continue;  // its neighbour has it the other way
      low.push_back(p + (at - p[axis]) / (next[axis] - p[axis]) * (next - p));
      high.push_back(low.back());
    }
    begin = end;
  }
  return estimated_volume(low) + estimated_volume(high);
}

// The best cut at one of the places, if it is better.
void try_cuts(const Estimated& cell, Eigen::Index axis, const std::vector<double>& places,
              Cut& best) {
  for (const double at : places) {
    const double volume = estimated_volume(cell, axis, at);
    if (volume < best.volume_m3) best = {axis, at, volume};
  }
}

// Just before and behind the corner of the surface that is next to the cut: concave edges are
// where a cut gains most.
std::vector<double> beside_corner(const Points& corners, const Cut& cut, double extent) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& p : corners) {
    if (std::abs(p[cut.axis] - cut.at) < std::abs(nearest - cut.at)) nearest = p[cut.axis];
  }
  return {nearest - kBeside * extent, nearest + kBeside * extent};
}

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

// By its triangles' orientation; wrong when they overlap or are not of one mind.
double enclosed_volume(const MeshData& mesh) {
  double sum = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const Eigen::Vector3d& origin = mesh.vertices[0];
    const Eigen::Vector3d a = mesh.vertices[t[0]] - origin;
    const Eigen::Vector3d b = mesh.vertices[t[1]] - origin;
    sum += a.dot(b.cross(mesh.vertices[t[2]] - origin));
  }
  return std::abs(sum) / 6.0;
}

std::optional<Cell3> side_of(const Cell3& cell, const Cut& cut, double sign, const MeshData& mesh) {
  Cell3 side{cell.box, clipped(cell.surface, cut.axis, cut.at, sign), {}, 0.0};
  (sign > 0.0 ? side.box.min() : side.box.max())[cut.axis] = cut.at;
  Points points = side.surface.corners;
  const Points corners = enclosed_corners(side.box, mesh);
  points.insert(points.end(), corners.begin(), corners.end());
  if (points.empty()) return std::nullopt;
  auto hull = convex_hull(points);
  if (!hull) return std::nullopt;
  side.hull = *std::move(hull);
  side.volume_m3 = volume_m3(side.hull);
  return side;
}

// Both sides of the cell's best cut, when it gains enough.
std::vector<Cell3> parted(const Cell3& cell, const MeshData& mesh, double least_gain_m3) {
  const Cut cut = best_cut(cell.surface);
  if (!(cut.volume_m3 < cell.volume_m3)) return {};
  auto low = side_of(cell, cut, -1.0, mesh);
  auto high = side_of(cell, cut, 1.0, mesh);
  if (!low || !high) return {};
  if (cell.volume_m3 - low->volume_m3 - high->volume_m3 < least_gain_m3) return {};
  std::vector<Cell3> sides;
  sides.push_back(*std::move(low));
  sides.push_back(*std::move(high));
  return sides;
}

Cell3 whole(const MeshData& mesh) {
  Cell3 cell;
  const double inf = std::numeric_limits<double>::infinity();
  cell.box = Eigen::AlignedBox3d(Eigen::Vector3d::Constant(-inf), Eigen::Vector3d::Constant(inf));
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t i : t) cell.surface.corners.push_back(mesh.vertices[i]);
    cell.surface.ends.push_back(cell.surface.corners.size());
  }
  cell.hull = mesh.hull;
  cell.volume_m3 = volume_m3(mesh.hull);
  return cell;
}

}  // namespace

double volume_m3(const ConvexHull& hull) {
  double sum = 0.0;
  for (const auto& face : hull.faces) {
    const Eigen::Vector3d a = hull.vertices[face[0]] - hull.vertices[0];
    const Eigen::Vector3d b = hull.vertices[face[1]] - hull.vertices[0];
    sum += a.dot(b.cross(hull.vertices[face[2]] - hull.vertices[0]));
  }
  return sum / 6.0;
}

std::vector<ConvexHull> convex_pieces(const MeshData& mesh) {
  if (mesh.triangles.size() > kMaxTrianglesCut || !is_closed(mesh.triangles)) return {mesh.hull};
  std::vector<Cell3> open{whole(mesh)};
  const double least_gain_m3 = kCutGain * open.front().volume_m3;
  if (open.front().volume_m3 - enclosed_volume(mesh) < least_gain_m3) return {mesh.hull};
  std::vector<ConvexHull> pieces;
  while (!open.empty()) {
    // The largest first: the number of pieces is bounded.
    const auto largest =
        std::max_element(open.begin(), open.end(),
                         [](const auto& a, const auto& b) { return a.volume_m3 < b.volume_m3; });
    Cell3 cell = std::move(*largest);
    open.erase(largest);
    std::vector<Cell3> sides;
    if (pieces.size() + open.size() + 2 <= kMaxPieces) sides = parted(cell, mesh, least_gain_m3);
    if (sides.empty()) {
      pieces.push_back(std::move(cell.hull));
    } else {
      std::move(sides.begin(), sides.end(), std::back_inserter(open));
    }
  }
  return pieces;
}

}  // namespace armloom
