#include "core/geometry/mesh/convex_pieces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include "core/geometry/mesh/best_cut.h"
#include "core/geometry/spread_directions.h"

namespace armloom {
namespace {

constexpr int kEscapeDirections = 40;

// A box of space, and the part of the surface in it.
struct Block {
  Eigen::AlignedBox3d box;
  Polygons surface;
  ConvexHull hull;
  double volume_m3 = 0.0;
};

// Returns true if the ray may hit the triangle, including doubtful cases.
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
  // The line of the ray hits the triangle. If all corners are behind the ray's origin, the ray does
  // not.
  return std::any_of(t.begin(), t.end(), [&](const Eigen::Vector3d& p) {
    return direction.dot(p - from) > -kDoubt * ((p - from).norm() + kDoubt);
  });
}

// Returns true if one of the rays tried from p does not hit the surface, so that the surface does
// not enclose p.
bool escapes(const Eigen::Vector3d& p, const MeshData& mesh) {
  static const Points kDirections = spread_directions(kEscapeDirections);
  return std::any_of(kDirections.begin(), kDirections.end(), [&](const Eigen::Vector3d& n) {
    return std::none_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
      return may_hit(p, n, {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
    });
  });
}

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

// Returns the enclosed volume (m^3), computed from the triangles' orientation. Wrong if triangles
// overlap or their orientations are inconsistent.
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

std::optional<Block> side_of(const Block& cell, const Cut& cut, double sign, const MeshData& mesh) {
  Block side{cell.box, clipped(cell.surface, cut, sign), {}, 0.0};
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

// Returns both sides of the best cut, or an empty list if the cut removes too little volume.
std::vector<Block> parted(const Block& cell, const MeshData& mesh, double least_gain_m3) {
  const Cut cut = best_cut(cell.surface);
  if (!(cut.volume_m3 < cell.volume_m3)) return {};
  auto low = side_of(cell, cut, -1.0, mesh);
  auto high = side_of(cell, cut, 1.0, mesh);
  if (!low || !high) return {};
  if (cell.volume_m3 - low->volume_m3 - high->volume_m3 < least_gain_m3) return {};
  std::vector<Block> sides;
  sides.push_back(*std::move(low));
  sides.push_back(*std::move(high));
  return sides;
}

Block whole(const MeshData& mesh) {
  Block cell;
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

std::vector<ConvexHull> convex_pieces(const MeshData& mesh) {
  if (mesh.triangles.size() > kMaxTrianglesCut || !is_closed(mesh.triangles)) return {mesh.hull};
  std::vector<Block> open{whole(mesh)};
  const double least_gain_m3 = kCutGain * open.front().volume_m3;
  if (open.front().volume_m3 - enclosed_volume(mesh) < least_gain_m3) return {mesh.hull};
  std::vector<ConvexHull> pieces;
  while (!open.empty()) {
    // The largest block is cut first, because the number of pieces is limited.
    const auto largest =
        std::max_element(open.begin(), open.end(),
                         [](const auto& a, const auto& b) { return a.volume_m3 < b.volume_m3; });
    Block cell = std::move(*largest);
    open.erase(largest);
    std::vector<Block> sides;
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
