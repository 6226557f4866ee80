#include "core/geometry/mesh/convex_pieces.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>

#include "test/geometry/small_meshes.h"

namespace armloom {
namespace {

// Returns how far the point is outside of the polytope; negative if inside.
double outside(const ConvexHull& hull, const Eigen::Vector3d& p) {
  double farthest = -1e9;
  for (const auto& face : hull.faces) {
    const Eigen::Vector3d& a = hull.vertices[face[0]];
    const Eigen::Vector3d n =
        (hull.vertices[face[1]] - a).cross(hull.vertices[face[2]] - a).normalized();
    if (n.allFinite()) farthest = std::max(farthest, n.dot(p - a));
  }
  return farthest;
}

double outside(const std::vector<ConvexHull>& pieces, const Eigen::Vector3d& p) {
  double least = 1e9;
  for (const ConvexHull& piece : pieces) least = std::min(least, outside(piece, p));
  return least;
}

double volume(const std::vector<ConvexHull>& pieces) {
  double sum = 0.0;
  for (const ConvexHull& piece : pieces) sum += volume_m3(piece);
  return sum;
}

MeshData data_of(const small::Surface& surface) { return *small::mesh_of(surface).data; }

// Returns the prism over a polygon. Its caps are fans about `center`, so the polygon must be
// star-shaped about `center`.
small::Surface prism(const std::vector<Eigen::Vector2d>& outline, const Eigen::Vector2d& center,
                     double height) {
  small::Surface surface;
  const auto n = static_cast<std::uint32_t>(outline.size());
  for (const double z : {0.0, height}) {
    for (const Eigen::Vector2d& p : outline) surface.vertices.emplace_back(p.x(), p.y(), z);
  }
  surface.vertices.emplace_back(center.x(), center.y(), 0.0);
  surface.vertices.emplace_back(center.x(), center.y(), height);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    surface.triangles.push_back({i, j, n + j});
    surface.triangles.push_back({i, n + j, n + i});
    surface.triangles.push_back({j, i, 2 * n});
    surface.triangles.push_back({n + i, n + j, 2 * n + 1});
  }
  return surface;
}

small::Surface letter_l() {
  return prism({{0, 0}, {1, 0}, {1, 0.2}, {0.2, 0.2}, {0.2, 1}, {0, 1}}, {0.1, 0.1}, 0.3);
}

// Returns true if the point is inside a polygon that is star-shaped about `center`.
bool in_star(const std::vector<Eigen::Vector2d>& outline, const Eigen::Vector2d& center,
             const Eigen::Vector2d& p) {
  const auto cross = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() * b.y() - a.y() * b.x();
  };
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d& a = outline[i];
    const Eigen::Vector2d& b = outline[(i + 1) % outline.size()];
    if (cross(a - center, p - center) >= 0 && cross(b - a, p - a) >= 0 &&
        cross(center - b, p - b) >= 0) {
      return true;
    }
  }
  return false;
}

TEST(ConvexPieces, ConvexMeshIsOnePiece) {
  const MeshData box = data_of(small::box_surface({-1, -2, 0}, {1, 2, 0.5}));
  const auto pieces = convex_pieces(box);
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_EQ(pieces[0].vertices.size(), box.hull.vertices.size());
  EXPECT_NEAR(volume_m3(pieces[0]), 4.0, 1e-12);
}

TEST(ConvexPieces, LShapeIsSplitIntoTwoBars) {
  const MeshData mesh = data_of(letter_l());
  const auto pieces = convex_pieces(mesh);
  EXPECT_EQ(pieces.size(), 2U);
  EXPECT_NEAR(volume_m3(mesh.hull), 0.3 * (1.0 - 0.8 * 0.8 / 2), 1e-9);
  EXPECT_NEAR(volume(pieces), 0.3 * (0.2 + 0.8 * 0.2), 1e-3);
  EXPECT_GT(outside(pieces, {0.3, 0.3, 0.15}), 0.09);  // inside of the hull
  EXPECT_LT(outside(mesh.hull, {0.3, 0.3, 0.15}), -0.1);
}

TEST(ConvexPieces, UShapeKeepsItsGapOpen) {
  for (const double slot : {0.02, 0.3, 0.8}) {
    const MeshData mesh = data_of(small::channel(slot));
    const auto pieces = convex_pieces(mesh);
    EXPECT_GE(pieces.size(), slot > 0.1 ? 3U : 1U);
    if (slot < 0.1) continue;  // too little volume (2 %) to justify a cut
    EXPECT_NEAR(volume(pieces), 1.0 - slot + 0.1, 2e-3);
    EXPECT_GT(outside(pieces, {0, 0, 0.5}), slot / 2 - 1e-3);
    EXPECT_LT(outside(mesh.hull, {0, 0, 0.5}), -0.4);
  }
}

TEST(ConvexPieces, ContainEveryPointOfRandomSolids) {
  std::mt19937_64 random(51);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::size_t cut = 0;
  for (int trial = 0; trial < 60; ++trial) {
    std::vector<Eigen::Vector2d> outline;
    const int corners = 6 + trial % 9;
    const Eigen::Vector2d center(unit(random), unit(random));
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * 3.14159265358979 * i / corners;
      outline.push_back(center +
                        (0.1 + unit(random)) * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    }
    const Eigen::Matrix3d R =
        Eigen::AngleAxisd(unit(random), Eigen::Vector3d(1, unit(random), 2).normalized())
            .toRotationMatrix();
    small::Surface surface = prism(outline, center, 0.4);
    for (Eigen::Vector3d& p : surface.vertices) p = R * p;
    const auto pieces = convex_pieces(data_of(surface));
    ASSERT_LE(pieces.size(), kMaxPieces);
    if (pieces.size() > 1) ++cut;
    int inside = 0;
    for (int i = 0; i < 3000; ++i) {
      const Eigen::Vector2d p =
          center + 2.4 * Eigen::Vector2d(unit(random) - 0.5, unit(random) - 0.5);
      if (!in_star(outline, center, p)) continue;
      ++inside;
      const double z = i % 4 == 0 ? (i % 8 == 0 ? 0.0 : 0.4) : 0.4 * unit(random);
      ASSERT_LE(outside(pieces, R * Eigen::Vector3d(p.x(), p.y(), z)), kHullTolerance_m)
          << "trial " << trial;
    }
    EXPECT_GT(inside, 100);
    for (const Triangle& t : surface.triangles) {
      for (int i = 0; i < 20; ++i) {
        const double u = unit(random);
        const double v = (1 - u) * unit(random);
        const Eigen::Vector3d p = u * surface.vertices[t[0]] + v * surface.vertices[t[1]] +
                                  (1 - u - v) * surface.vertices[t[2]];
        ASSERT_LE(outside(pieces, p), kHullTolerance_m) << "trial " << trial;
      }
    }
  }
  EXPECT_GT(cut, 30U);
}

// The cuts leave boxes whose corners may be deep inside the solid, far from any triangle.
TEST(ConvexPieces, ContainTheInteriorOfASolid) {
  std::mt19937_64 random(52);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::size_t pieces_seen = 0;
  for (int trial = 0; trial < 15; ++trial) {
    // Overlapping bars, rotated together, form a solid.
    const Eigen::Matrix3d R =
        Eigen::AngleAxisd(unit(random), Eigen::Vector3d(1, unit(random), 2).normalized())
            .toRotationMatrix();
    std::vector<Eigen::AlignedBox3d> bars;
    small::Surface surface;
    for (int i = 0; i < 6; ++i) {
      Eigen::Vector3d half(0.3, 0.3, 0.3);
      half[i % 3] = 0.7 + 0.3 * unit(random);
      const Eigen::Vector3d middle =
          0.4 * Eigen::Vector3d(unit(random), unit(random), unit(random));
      bars.emplace_back(middle - half, middle + half);
      small::Surface bar = small::box_surface(middle - half, middle + half);
      for (Eigen::Vector3d& p : bar.vertices) p = R * p;
      surface = small::joined(std::move(surface), bar);
    }
    const auto pieces = convex_pieces(data_of(surface));
    pieces_seen += pieces.size();
    for (const Eigen::AlignedBox3d& bar : bars) {
      for (int i = 0; i < 1000; ++i) {
        const Eigen::Vector3d p =
            bar.center() + 0.5 * bar.sizes().cwiseProduct(
                                     Eigen::Vector3d(unit(random), unit(random), unit(random)));
        ASSERT_LE(outside(pieces, R * p), kHullTolerance_m) << "trial " << trial;
      }
    }
  }
  EXPECT_GT(pieces_seen, 30U);
}

TEST(ConvexPieces, OpenMeshIsReplacedByItsHull) {
  small::Surface open = letter_l();
  open.triangles.pop_back();
  EXPECT_EQ(convex_pieces(data_of(open)).size(), 1U);
  small::Surface inside_out = letter_l();
  for (Triangle& t : inside_out.triangles) std::swap(t[0], t[1]);
  EXPECT_EQ(convex_pieces(data_of(inside_out)).size(), 2U);
}

}  // namespace
}  // namespace armloom
