#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "core/collision/state/clearance_query.h"
#include "core/geometry/convex/convex_shape.h"
#include "core/geometry/convex/exact_distance.h"
#include "test/collision/scaled_query.h"
#include "test/collision/small_cell.h"
#include "test/geometry/reference_distance.h"
#include "test/geometry/small_meshes.h"

namespace armloom {
namespace {

using Points = std::vector<Eigen::Vector3d>;

double point_to_triangle(const Eigen::Vector3d& p, const std::array<Eigen::Vector3d, 3>& t) {
  const Eigen::Vector3d n = (t[1] - t[0]).cross(t[2] - t[0]);
  bool inside = n.norm() > 1e-15;
  double nearest = 1e9;
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d edge = t[(i + 1) % 3] - t[i];
    if (edge.cross(p - t[i]).dot(n) < 0.0) inside = false;
    const double s = std::clamp(edge.dot(p - t[i]) / std::max(edge.squaredNorm(), 1e-30), 0.0, 1.0);
    nearest = std::min(nearest, (p - t[i] - s * edge).norm());
  }
  return inside ? std::abs(n.normalized().dot(p - t[0])) : nearest;
}

double edge_to_edge(const Eigen::Vector3d& p, const Eigen::Vector3d& d, const Eigen::Vector3d& q,
                    const Eigen::Vector3d& e) {
  const Eigen::Vector3d n = d.cross(e);
  if (n.norm() < 1e-12) return 1e9;  // parallel: the distance at an end is as small
  const Eigen::Vector3d w = q - p;
  const double s = w.cross(e).dot(n) / n.squaredNorm();
  const double t = w.cross(d).dot(n) / n.squaredNorm();
  if (s < 0.0 || s > 1.0 || t < 0.0 || t > 1.0) return 1e9;
  return std::abs(w.dot(n.normalized()));
}

struct Solid {
  Points p_W;
  std::vector<Triangle> faces;
  [[nodiscard]] std::array<Eigen::Vector3d, 3> face(std::size_t i) const {
    return {p_W[faces[i][0]], p_W[faces[i][1]], p_W[faces[i][2]]};
  }
};

// Returns the smallest distance of any two features (vertices, edges, faces). Exact unless the
// solids overlap.
double brute_distance(const Solid& a, const Solid& b) {
  double nearest = 1e9;
  for (std::size_t i = 0; i < a.faces.size(); ++i) {
    for (std::size_t j = 0; j < b.faces.size(); ++j) {
      const auto s = a.face(i);
      const auto t = b.face(j);
      for (std::size_t k = 0; k < 3; ++k) {
        nearest = std::min({nearest, point_to_triangle(s[k], t), point_to_triangle(t[k], s)});
        for (std::size_t m = 0; m < 3; ++m) {
          nearest = std::min(
              nearest, edge_to_edge(s[k], s[(k + 1) % 3] - s[k], t[m], t[(m + 1) % 3] - t[m]));
        }
      }
    }
  }
  return nearest;
}

// Returns true if the plane of a face separates the solids.
bool apart(const Solid& a, const Solid& b) {
  for (const auto* solid : {&a, &b}) {
    const Solid& other = solid == &a ? b : a;
    for (std::size_t i = 0; i < solid->faces.size(); ++i) {
      const auto t = solid->face(i);
      const Eigen::Vector3d n = (t[1] - t[0]).cross(t[2] - t[0]).normalized();
      double least = 1e9;
      for (const Eigen::Vector3d& p : other.p_W) least = std::min(least, n.dot(p - t[0]));
      if (least > 1e-9) return true;
    }
  }
  return false;  // touching, or separable only by a plane across two edges
}

Points random_points(std::mt19937_64& random, int count, const Eigen::Vector3d& size) {
  std::normal_distribution<double> place;
  Points points;
  for (int i = 0; i < count; ++i) {
    points.emplace_back(
        Eigen::Vector3d(place(random), place(random), place(random)).cwiseProduct(size));
  }
  return points;
}

Mesh cloud(const Points& points) {
  const ConvexHull hull = convex_hull(points).value();
  return small::mesh_of({hull.vertices, hull.faces});
}

Solid solid_at(const Mesh& mesh, const Eigen::Isometry3d& X_WM) {
  Solid solid{mesh.data->hull.vertices, mesh.data->hull.faces};
  for (Eigen::Vector3d& p : solid.p_W) p = X_WM * p;
  return solid;
}

double distance_of(const ConvexShape& a, const Eigen::Isometry3d& X_WA, const ConvexShape& b,
                   const Eigen::Isometry3d& X_WB, double limit_m = 1e3) {
  PlacedConvexShape at_a{};
  PlacedConvexShape at_b{};
  place(a, X_WA, at_a);
  place(b, X_WB, at_b);
  return distance_below(a, at_a, b, at_b, limit_m);
}

TEST(MeshShape, DistanceIsThatOfTheNearestFeatures) {
  std::mt19937_64 random(11);
  int compared = 0;
  for (int i = 0; i < 400; ++i) {
    const Mesh a = cloud(random_points(random, 6 + i % 40, {0.05, 0.08, 0.2}));
    const Mesh b = cloud(random_points(random, 40 - i % 30, {0.1, 0.03, 0.1}));
    const Eigen::Isometry3d X_WA = reference::random_pose(random, 0.4);
    const Eigen::Isometry3d X_WB = reference::random_pose(random, 0.4);
    const Solid solid_a = solid_at(a, X_WA);
    const Solid solid_b = solid_at(b, X_WB);
    const double distance = distance_of(make_convex_shapes({{a}}).front(), X_WA,
                                        make_convex_shapes({{b}}).front(), X_WB);
    const double truth = brute_distance(solid_a, solid_b);
    ASSERT_LE(distance, truth + 1e-12) << i;  // never too large, even for overlapping solids
    if (!apart(solid_a, solid_b)) continue;
    ++compared;
    EXPECT_NEAR(distance, truth, 1e-6) << i;
  }
  EXPECT_GT(compared, 200);
}

TEST(MeshShape, BoxMeshHasTheDistancesOfABox) {
  std::mt19937_64 random(12);
  const std::vector<PlacedShape> others[] = {{{Box{{0.1, 0.2, 0.05}}}},
                                             {{Sphere{0.07}}},
                                             {{Cylinder{0.05, 0.3}}},
                                             small::capsule_along_x(-0.1, 0.2, 0.04),
                                             {{cloud(random_points(random, 30, {0.1, 0.1, 0.1}))}}};
  const Eigen::Vector3d half(0.2, 0.1, 0.05);
  const ConvexShape box = make_convex_shapes({{Box{2 * half}}}).front();
  const ConvexShape mesh =
      make_convex_shapes({{small::mesh_of(small::box_surface(-half, half))}}).front();
  for (int i = 0; i < 2000; ++i) {
    const ConvexShape other = make_convex_shapes(others[i % 5]).front();
    const Eigen::Isometry3d X_WA = reference::random_pose(random, 0.3);
    const Eigen::Isometry3d X_WB = reference::random_pose(random, 0.3);
    const double to_box = std::max(0.0, distance_of(box, X_WA, other, X_WB));
    EXPECT_NEAR(std::max(0.0, distance_of(mesh, X_WA, other, X_WB)), to_box, 2e-6) << i;
    EXPECT_NEAR(std::max(0.0, distance_of(other, X_WB, mesh, X_WA)), to_box, 2e-6) << i;
  }
}

TEST(MeshShape, LiesInItsCapsuleAndItsBox) {
  std::mt19937_64 random(13);
  for (int i = 0; i < 200; ++i) {
    const Mesh mesh = cloud(random_points(random, 5 + i, {0.1, 0.5, 0.02}));
    const ConvexShape body =
        make_convex_shapes({{mesh, reference::random_pose(random, 1.0)}}).front();
    for (const Eigen::Vector3d& p : body.hull->hull.vertices) {
      const double beside = std::max(0.0, std::abs(p.z()) - body.half_length_m);
      EXPECT_LE(std::hypot(p.x(), p.y(), beside), body.radius_m + 1e-15);
      EXPECT_TRUE((p.cwiseAbs().array() <= body.half_size_m.array()).all());
    }
  }
}

TEST(MeshShape, LowerBoundNeverExceedsTheExactDistance) {
  std::mt19937_64 random(14);
  const std::vector<PlacedShape> shapes[] = {
      {{Box{{0.1, 0.2, 0.05}}}},
      {{Sphere{0.07}}},
      {{Cylinder{0.05, 0.3}}},
      {{cloud(random_points(random, 30, {0.1, 0.02, 0.05}))}}};
  for (int i = 0; i < 4000; ++i) {
    const ConvexShape a = make_convex_shapes(shapes[3]).front();
    const ConvexShape b = make_convex_shapes(shapes[i % 4]).front();
    PlacedConvexShape at_a{};
    PlacedConvexShape at_b{};
    place(a, reference::random_pose(random, 0.25), at_a);
    place(b, reference::random_pose(random, 0.25), at_b);
    const double exact = exact_distance(a, shape_pose(a, at_a), b, shape_pose(b, at_b));
    EXPECT_LE(lower_bound(a, at_a, b, at_b).distance_m, exact + 3e-7) << i;
    EXPECT_LE(lower_bound(b, at_b, a, at_a).distance_m, exact + 3e-7) << i;
    for (const double limit : {0.01, 0.1}) {
      EXPECT_NEAR(std::max(0.0, distance_below(a, at_a, b, at_b, limit)), std::min(limit, exact),
                  1e-6)
          << i;
    }
  }
}

TEST(MeshShape, ShapeInsideAnotherIsInContact) {
  const ConvexShape crate =
      make_convex_shapes({{small::mesh_of(small::box_surface({-1, -1, -1}, {1, 1, 1}))}}).front();
  const ConvexShape ball = make_convex_shapes({{Sphere{0.1}}}).front();
  const ConvexShape part =
      make_convex_shapes({{small::mesh_of(small::box_surface({-.1, -.1, -.1}, {.1, .1, .1}))}})
          .front();
  const Eigen::Isometry3d X = small::at_xyz(0.3, 0.2, -0.1);
  EXPECT_LE(distance_of(crate, small::at_xyz(0, 0, 0), ball, X), 0.0);
  EXPECT_LE(distance_of(part, X, crate, small::at_xyz(0, 0, 0)), 0.0);
}

TEST(PlanningScene, MeshWithoutPiecesIsReplacedByItsHull) {
  Cell cell;
  small::add_robot(cell, "a", small::at_xyz(0, 0, 0), {Eigen::Vector3d::UnitZ()}, {0.4, 0.03});
  // The arm is inside a slot, but the hull has no slot.
  cell.objects.push_back(
      {"channel", small::mesh_of(small::channel(0.3)), small::at_xyz(0.0, -0.2, -0.5)});
  auto scene = PlanningScene::build(small::shared(cell));
  ASSERT_TRUE(scene.has_value());
  small::ScaledQuery checker(*scene);
  const auto contact = checker.first_closer_than(cell.home(), 0.02, {true});
  ASSERT_TRUE(contact.has_value());
  EXPECT_EQ(contact->body_b, "channel");
}

}  // namespace
}  // namespace armloom
