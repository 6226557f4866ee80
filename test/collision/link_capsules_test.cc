#include "core/collision/scene/link_capsules.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "core/collision/scene/scene_bodies.h"
#include "core/geometry/mesh/convex_pieces.h"
#include "test/collision/small_cell.h"
#include "test/geometry/reference_distance.h"
#include "test/geometry/small_meshes.h"
#include "test/model/test_cells.h"

namespace armloom {
namespace {

Eigen::Vector3d random_direction(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
}

// Returns a point on the original shape, not on its ConvexShape.
Eigen::Vector3d surface_point(const PlacedShape& placed, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const Eigen::Vector3d n = random_direction(random);
  Eigen::Vector3d p;
  if (const auto* box = std::get_if<Box>(&placed.shape)) {
    p = box->size_m.cwiseProduct(Eigen::Vector3d(unit(random), unit(random), unit(random)));
    p[static_cast<int>(random() % 3)] = unit(random) < 0 ? -1e9 : 1e9;
    p = p.cwiseMin(box->size_m).cwiseMax(-box->size_m) / 2;
  } else if (const auto* cylinder = std::get_if<Cylinder>(&placed.shape)) {
    const double angle = small::kHalfTurn * unit(random);
    p = {cylinder->radius_m * std::cos(angle), cylinder->radius_m * std::sin(angle),
         std::copysign(cylinder->length_m / 2, unit(random))};
  } else if (const auto* sphere = std::get_if<Sphere>(&placed.shape)) {
    p = sphere->radius_m * n;
  } else {
    const auto& vertices = std::get<Mesh>(placed.shape).data->vertices;
    p = vertices[random() % vertices.size()];
  }
  return placed.X_LS * p;
}

PlacedShape random_shape(std::mt19937_64& random) {
  std::uniform_real_distribution<double> size(0.01, 0.3);
  const Eigen::Isometry3d X = reference::random_pose(random, 0.5);
  switch (random() % 4) {
    case 0:
      return {Sphere{size(random)}, X};
    case 1:
      return {Cylinder{size(random), 2 * size(random)}, X};
    case 2:
      return {Box{{size(random), size(random), 3 * size(random)}}, X};
    default: {
      const Eigen::Vector3d half(size(random), size(random), size(random));
      return {small::mesh_of(small::box_surface(-half, half)), X};
    }
  }
}

double outside(const LinkCapsule& capsule, const Eigen::Vector3d& p) {
  // Independent of the fitting and its check.
  const CenteredSegment segment{(capsule.p_PA + capsule.p_PB) / 2,
                                (capsule.p_PB - capsule.p_PA) / 2};
  return segment_segment_distance(segment, {p, Eigen::Vector3d::Zero()}) - capsule.radius_m;
}

double volume(const LinkCapsules& fitted) {
  double sum = 0.0;
  for (const LinkCapsule& capsule : fitted.capsules) sum += capsule.volume_m3();
  return sum;
}

TEST(LinkCapsules, ContainRandomLinksWithEachShapeInOneCapsule) {
  std::mt19937_64 random(41);
  int with_two = 0;
  for (int trial = 0; trial < 150; ++trial) {
    std::vector<PlacedShape> shapes;
    const std::size_t count = 1 + random() % 10;
    for (std::size_t i = 0; i < count; ++i) shapes.push_back(random_shape(random));
    const LinkCapsules fitted = fit_capsules(make_convex_shapes(shapes));
    ASSERT_GE(fitted.capsules.size(), 1U);
    ASSERT_LE(fitted.capsules.size(), 2U);
    if (fitted.capsules.size() == 2) ++with_two;
    for (const PlacedShape& shape : shapes) {
      std::vector<double> worst(fitted.capsules.size(), -1e9);
      for (int i = 0; i < 200; ++i) {
        const Eigen::Vector3d p = surface_point(shape, random);
        for (std::size_t c = 0; c < worst.size(); ++c) {
          worst[c] = std::max(worst[c], outside(fitted.capsules[c], p));
        }
      }
      EXPECT_LE(*std::min_element(worst.begin(), worst.end()), 1e-15) << "trial " << trial;
    }
  }
  EXPECT_GT(with_two, 20);
}

TEST(LinkCapsules, EqualASingleRoundShapeBitForBit) {
  std::mt19937_64 random(42);
  for (int i = 0; i < 100; ++i) {
    auto shapes = small::capsule_along_x(-0.1 - 0.01 * i, 0.3, 0.05);
    const Eigen::Isometry3d X = reference::random_pose(random, 1.0);
    for (PlacedShape& shape : shapes) shape.X_LS = X * shape.X_LS;
    const auto bodies = make_convex_shapes(shapes);
    ASSERT_EQ(bodies.size(), 1U);
    const LinkCapsules fitted = fit_capsules(bodies);
    ASSERT_EQ(fitted.capsules.size(), 1U);
    const LinkCapsule& capsule = fitted.capsules.front();
    EXPECT_EQ(capsule.radius_m, bodies[0].radius_m);
    EXPECT_EQ(capsule.p_PA, bodies[0].X_PS.translation() - bodies[0].p_SE_P);
    EXPECT_EQ(capsule.p_PB, bodies[0].X_PS.translation() + bodies[0].p_SE_P);
    EXPECT_LE(fitted.overestimate_m, 1e-12);
  }
}

TEST(LinkCapsules, EqualARoundShapeThatContainsTheOthers) {
  auto shapes = small::capsule_along_x(-0.2, 0.2, 0.1);
  shapes.push_back({Box{{0.3, 0.05, 0.05}}, small::at_xyz(0.02, 0.01, 0)});
  const LinkCapsules fitted = fit_capsules(make_convex_shapes(shapes));
  ASSERT_EQ(fitted.capsules.size(), 1U);
  EXPECT_EQ(fitted.capsules.front().radius_m, make_convex_shapes(shapes).front().radius_m);
}

TEST(LinkCapsules, AreAsThinAsALongBar) {
  std::mt19937_64 random(43);
  for (int i = 0; i < 20; ++i) {
    const Eigen::Isometry3d X = reference::random_pose(random, 1.0);
    const LinkCapsules fitted = fit_capsules(make_convex_shapes({{Box{{0.06, 0.08, 1.0}}, X}}));
    ASSERT_EQ(fitted.capsules.size(), 1U);
    EXPECT_LE(fitted.capsules.front().radius_m, 0.05 * 1.02);
    EXPECT_LE((fitted.capsules.front().p_PB - fitted.capsules.front().p_PA).norm(), 1.0);
    // The capsule is 20 mm (50 mm - 30 mm) larger than the box at two sides, and almost a radius
    // longer at its tips.
    EXPECT_GE(fitted.overestimate_m, 0.02);
    EXPECT_LE(fitted.overestimate_m, 0.05);
  }
}

TEST(LinkCapsules, CubeGetsItsBoundingSphere) {
  const LinkCapsules fitted = fit_capsules(make_convex_shapes({{Box{{0.2, 0.2, 0.2}}}}));
  const double ball = 4.0 / 3.0 * small::kHalfTurn * std::pow(0.1 * std::sqrt(3.0), 3);
  EXPECT_LE(volume(fitted), ball * 1.001);
}

TEST(LinkCapsules, EqualTwoRoundShapesAtAnAngle) {
  auto shapes = small::capsule_along_x(0.0, 0.5, 0.04);
  Eigen::Isometry3d turn = Eigen::Isometry3d::Identity();
  turn.linear() = Eigen::AngleAxisd(1.4, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  for (PlacedShape shape : small::capsule_along_x(0.0, 0.4, 0.06)) {
    shape.X_LS = turn * shape.X_LS;
    shapes.push_back(shape);
  }
  const auto bodies = make_convex_shapes(shapes);
  const LinkCapsules fitted = fit_capsules(bodies);
  ASSERT_EQ(bodies.size(), 2U);
  ASSERT_EQ(fitted.capsules.size(), 2U);
  EXPECT_LE(fitted.overestimate_m, 1e-3);
}

TEST(LinkCapsules, OfAFlatDiskAreNoLargerThanItsBoundingSphere) {
  // For a flat disk the principal axis is arbitrary.
  const LinkCapsules disc = fit_capsules(make_convex_shapes({{Cylinder{0.2, 0.02}}}));
  const double ball = 4.0 / 3.0 * small::kHalfTurn * std::pow(std::hypot(0.2, 0.01), 3);
  EXPECT_LE(volume(disc), ball * 1.005);
}

TEST(LinkCapsules, ContainsReturnsFalseIfACornerSticksOut) {
  const ConvexShape box = make_convex_shapes({{Box{{0.1, 0.1, 0.4}}}}).front();
  const double across = std::hypot(0.05, 0.05);
  const Eigen::Vector3d half(0, 0, 0.2);
  EXPECT_TRUE(contains(LinkCapsule{-half, half, across * (1 + 1e-12)}, box));
  EXPECT_FALSE(contains(LinkCapsule{-half, half, across * (1 - 1e-12)}, box));
  const ConvexShape can = make_convex_shapes({{Cylinder{0.1, 0.4}}}).front();
  EXPECT_TRUE(contains(LinkCapsule{-half, half, 0.1013}, can));
  EXPECT_FALSE(contains(LinkCapsule{-half, half, 0.0999}, can));
  const ConvexShape ball = make_convex_shapes({{Sphere{0.1}}}).front();
  EXPECT_TRUE(contains(LinkCapsule{-half, half, 0.1}, ball));
  EXPECT_FALSE(contains(LinkCapsule{-half, half, std::nextafter(0.1, 0.0)}, ball));
}

Mesh cut(const small::Surface& surface) {
  MeshData data = *small::mesh_of(surface).data;
  data.pieces = convex_pieces(data);
  return {"by hand", Eigen::Vector3d::Ones(), std::make_shared<const MeshData>(std::move(data))};
}

double distance_between(const std::vector<ConvexShape>& a, const ConvexShape& b,
                        const Eigen::Isometry3d& X_WB) {
  PlacedConvexShape at_b;
  place(b, X_WB, at_b);
  double nearest = 1e9;
  for (const ConvexShape& body : a) {
    PlacedConvexShape at_a;
    place(body, Eigen::Isometry3d::Identity(), at_a);
    nearest = std::min(nearest, distance_below(body, at_a, b, at_b, 10.0));
  }
  return nearest;
}

TEST(MeshPieces, LeaveTheGapOfAUShapeFree) {
  const ConvexShape rod = make_convex_shapes({{Cylinder{0.02, 0.8}}}).front();
  const auto whole = make_convex_shapes({{small::mesh_of(small::channel(0.3))}});
  const auto pieces = make_convex_shapes({{cut(small::channel(0.3))}});
  ASSERT_EQ(whole.size(), 1U);
  ASSERT_GE(pieces.size(), 3U);
  const Eigen::Isometry3d in_gap = small::at_xyz(0.03, 0.1, 0.55);
  EXPECT_LE(distance_between(whole, rod, in_gap), 0.0);
  EXPECT_NEAR(distance_between(pieces, rod, in_gap), 0.10, 1e-4);
  EXPECT_LE(distance_between(pieces, rod, small::at_xyz(0.14, 0.1, 0.55)), 0.0);
  EXPECT_LE(distance_between(pieces, rod, small::at_xyz(0.03, 0.1, 0.39)),
            0.0);  // the floor
}

TEST(MeshPieces, BecomeOneCapsuleEach) {
  const small::Surface bars = small::joined(small::box_surface({0, 0, 0}, {1.0, 0.1, 0.1}),
                                            small::box_surface({0, 0.1, 0}, {0.1, 1.0, 0.1}));
  const LinkCapsules whole = fit_capsules(make_convex_shapes({{small::mesh_of(bars)}}));
  const LinkCapsules pieces = fit_capsules(make_convex_shapes({{cut(bars)}}));
  EXPECT_EQ(whole.capsules.size(), 1U);
  ASSERT_EQ(pieces.capsules.size(), 2U);
  EXPECT_LT(volume(pieces), 0.2 * volume(whole));
}

TEST(LinkCapsules, AreDeterministic) {
  std::mt19937_64 random(44);
  std::vector<PlacedShape> shapes;
  for (int i = 0; i < 5; ++i) shapes.push_back(random_shape(random));
  const LinkCapsules first = fit_capsules(make_convex_shapes(shapes));
  const LinkCapsules second = fit_capsules(make_convex_shapes(shapes));
  ASSERT_EQ(first.capsules.size(), second.capsules.size());
  for (std::size_t i = 0; i < first.capsules.size(); ++i) {
    EXPECT_EQ(first.capsules[i].p_PA, second.capsules[i].p_PA);
    EXPECT_EQ(first.capsules[i].p_PB, second.capsules[i].p_PB);
    EXPECT_EQ(first.capsules[i].radius_m, second.capsules[i].radius_m);
  }
}

TEST(LinkCapsules, OverestimatePandaLinksByAFewCentimeters) {
  const auto scene = PlanningScene::build(build_or_fail(two_pandas_description()));
  ASSERT_TRUE(scene.has_value());
  const PlanningScene::Bodies& bodies = (*scene)->bodies();
  for (std::size_t i = 0; i < bodies.links_end; ++i) {
    const CollisionBody& part = bodies.bodies[i];
    ASSERT_FALSE(part.fitted.capsules.empty()) << part.name;
    for (std::size_t b = part.shapes_begin; b < part.shapes_end; ++b) {
      EXPECT_TRUE(std::any_of(part.fitted.capsules.begin(), part.fitted.capsules.end(),
                              [&](const auto& c) { return contains(c, bodies.shapes[b]); }))
          << part.name;
    }
    RecordProperty(part.name, std::to_string(part.fitted.capsules.size()) + " capsules, " +
                                  std::to_string(part.fitted.overestimate_m) + " m");
    EXPECT_LE(part.fitted.overestimate_m, 0.05) << part.name;
  }
}

}  // namespace
}  // namespace armloom
