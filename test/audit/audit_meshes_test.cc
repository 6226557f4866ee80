#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "core/audit/audit.h"
#include "test/collision/small_cell.h"
#include "test/geometry/reference_distance.h"
#include "test/geometry/small_meshes.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;
const Eigen::Vector3d kZ = Eigen::Vector3d::UnitZ();
constexpr double kUp = small::kHalfTurn / 2;

// Returns a cell with `object` and one arm. The arm has one 0.4 m link, which turns in the plane z
// = 0 and has `shape` at its tip.
Cell cell_of(const Shape& shape, const Shape& object, const Eigen::Isometry3d& X_WO) {
  Cell cell;
  small::add_robot(cell, "a", small::at_xyz(0, 0, 0), {kZ}, {0.4, 0.03});
  cell.links[1].shapes.clear();
  small::add_shape(cell.links[1], shape, small::at_xyz(0.4, 0, 0));
  cell.objects.push_back({"part", object, X_WO});
  return cell;
}

AuditReport at_angle(const Cell& cell, double q) {
  auto report = audit(cell, {{at(0ms), Configuration::Constant(1, q)}}, 10ms);
  EXPECT_TRUE(report.has_value());
  return *report;
}

// The slot runs along y, is 0.2 m wide around x = 0, and contains the tip at (0, 0.4, 0).
const Eigen::Isometry3d kSlot = small::at_xyz(0, 0.4, -0.5);

TEST(AuditMeshes, ArmInASlotIsNoContactAlthoughTheHullIsSolid) {
  const Mesh channel = small::mesh_of(small::channel(0.2));
  const Mesh tip = small::mesh_of(small::box_surface({-0.05, -0.05, -0.05}, {0.05, 0.05, 0.05}));
  for (const Shape& shape : {Shape(tip), Shape(Sphere{0.05}), Shape(Box{{0.1, 0.1, 0.1}})}) {
    const AuditReport report = at_angle(cell_of(shape, channel, kSlot), kUp);
    EXPECT_FALSE(report.first_contact.has_value());
    ASSERT_TRUE(report.smallest_clearance.has_value());
    EXPECT_NEAR(report.smallest_clearance->distance_m, 0.1 - 0.05, 1e-6);
    EXPECT_EQ(report.smallest_clearance->body_b, "part");
  }
}

TEST(AuditMeshes, ArmAtTheWallOfASlotIsAContact) {
  const Mesh channel = small::mesh_of(small::channel(0.2));
  const Mesh tip = small::mesh_of(small::box_surface({-0.05, -0.05, -0.05}, {0.05, 0.05, 0.05}));
  for (const Shape& shape : {Shape(tip), Shape(Sphere{0.05}), Shape(Box{{0.1, 0.1, 0.1}})}) {
    const AuditReport report = at_angle(cell_of(shape, channel, kSlot), kUp + 0.15);
    ASSERT_TRUE(report.first_contact.has_value());
    EXPECT_EQ(report.first_contact->body_a, "a_link1");
    EXPECT_EQ(report.smallest_clearance->distance_m, 0.0);
  }
}

TEST(AuditMeshes, BodyInsideAnotherIsAContact) {
  const small::Surface large = small::box_surface({-1, -1, -1}, {1, 1, 1});
  const small::Surface small_box = small::box_surface({-0.05, -0.05, -0.05}, {0.05, 0.05, 0.05});
  // The second piece of this mesh lies inside the other mesh, the first piece far outside.
  const small::Surface two = small::joined(small::box_surface({5, 5, 5}, {6, 6, 6}), small_box);
  const std::pair<Shape, Shape> cases[] = {{small::mesh_of(small_box), small::mesh_of(large)},
                                           {Sphere{0.05}, small::mesh_of(large)},
                                           {Cylinder{0.05, 0.1}, small::mesh_of(large)},
                                           {small::mesh_of(small_box), Box{{2, 2, 2}}},
                                           {small::mesh_of(small_box), Sphere{1}},
                                           {small::mesh_of(large), Sphere{0.05}},
                                           {small::mesh_of(large), small::mesh_of(small_box)},
                                           {small::mesh_of(two), small::mesh_of(large)}};
  for (std::size_t i = 0; i < std::size(cases); ++i) {
    const AuditReport report =
        at_angle(cell_of(cases[i].first, cases[i].second, small::at_xyz(0.4, 0, 0)), 0.1);
    EXPECT_TRUE(report.first_contact.has_value()) << "case " << i;
  }
}

TEST(AuditMeshes, MeasuresDegenerateTriangles) {
  small::Surface wall = small::box_surface({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1});
  for (const Triangle& t : {Triangle{0, 0, 1}, Triangle{0, 3, 3}, Triangle{5, 5, 5}})
    wall.triangles.push_back(t);
  for (const Shape& shape : {Shape(Sphere{0.05}), Shape(Box{{0.1, 0.1, 0.1}})}) {
    const AuditReport report =
        at_angle(cell_of(shape, small::mesh_of(wall), small::at_xyz(0.6, 0, 0)), 0.0);
    ASSERT_TRUE(report.smallest_clearance.has_value());
    EXPECT_NEAR(report.smallest_clearance->distance_m, 0.05, 2e-6);
  }
}

// FCL's default solver overestimates these distances by up to 13 mm.
TEST(AuditShapes, MeasuresBoxesAtEqualHeights) {
  using reference::Convex;
  const Box arm{{0.5, 0.05, 0.05}};
  const Box cube{{0.02, 0.02, 0.02}};
  std::mt19937_64 random(15);
  std::uniform_real_distribution<double> angle(-0.7, 0.7);
  int near = 0;
  for (int i = 0; i < 300; ++i) {
    const Cell cell = cell_of(arm, cube, small::at_xyz(0.4, 0.08, 0));
    const double q = angle(random);
    Convex a{.kind = Convex::Kind::box, .half_size_m = arm.size_m / 2};
    a.X_WS = Eigen::AngleAxisd(q, kZ) * small::at_xyz(0.4, 0, 0);
    Convex b{.kind = Convex::Kind::box, .half_size_m = cube.size_m / 2};
    b.X_WS = small::at_xyz(0.4, 0.08, 0);
    const reference::Bracket truth = reference::distance(a, b);
    const AuditReport report = at_angle(cell, q);
    ASSERT_TRUE(report.smallest_clearance.has_value());
    EXPECT_LE(report.smallest_clearance->distance_m, truth.upper + 1e-6) << q;
    EXPECT_GE(report.smallest_clearance->distance_m, truth.lower - 1e-6) << q;
    near += truth.lower > 0.0 && truth.upper < 0.1 ? 1 : 0;
  }
  EXPECT_GT(near, 100);
}

TEST(AuditMeshes, MeasuresASweepLikeItsSingleStates) {
  Cell cell = cell_of(small::mesh_of(small::box_surface({-0.1, -0.05, -0.02}, {0.1, 0.05, 0.02})),
                      small::mesh_of(small::box_surface({-0.1, -0.2, -0.3}, {0.1, 0.2, 0.3})),
                      small::at_xyz(0.75, 0, 0));
  cell.objects.push_back({"wall", Box{{0.02, 1, 1}}, small::at_xyz(-0.6, 0, 0)});
  std::vector<RecordedState> states;
  double smallest = 1e9;
  for (int i = 0; i <= 300; ++i) {
    const Configuration q = Configuration::Constant(1, -2.0 + i * 0.0201);
    states.push_back({at(i * 10ms), q});
    smallest = std::min(smallest, at_angle(cell, q[0]).smallest_clearance->distance_m);
  }
  const auto whole = audit(cell, states, 10ms);
  ASSERT_TRUE(whole.has_value());
  EXPECT_FALSE(whole->first_contact.has_value());
  EXPECT_NEAR(whole->smallest_clearance->distance_m, smallest, 1e-12);
  EXPECT_GT(smallest, 0.05);
}

TEST(AuditMeshes, ClearanceOfTwoBoxesIsTheGapBetweenTheirFaces) {
  const Cell cell =
      cell_of(small::mesh_of(small::box_surface({-0.1, -0.05, -0.02}, {0.1, 0.05, 0.02})),
              small::mesh_of(small::box_surface({-0.1, -0.2, -0.3}, {0.1, 0.2, 0.3})),
              small::at_xyz(0.75, 0, 0));
  EXPECT_NEAR(at_angle(cell, 0.0).smallest_clearance->distance_m, 0.75 - 0.1 - 0.5, 1e-9);
}

}  // namespace
}  // namespace armloom
