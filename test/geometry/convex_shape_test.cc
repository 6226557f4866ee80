#include "core/geometry/convex/convex_shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "core/geometry/convex/exact_distance.h"
#include "core/geometry/convex/gjk.h"
#include "test/collision/small_cell.h"
#include "test/geometry/reference_distance.h"

namespace armloom {
namespace {

reference::Convex convex(const ConvexShape& body, const Eigen::Isometry3d& X_WP) {
  reference::Convex c{};
  using Kind = reference::Convex::Kind;
  c.kind = body.kind == ConvexShapeKind::box        ? Kind::box
           : body.kind == ConvexShapeKind::cylinder ? Kind::cylinder
                                                    : Kind::capsule;
  c.half_size_m = body.half_size_m;
  c.radius_m = body.radius_m;
  c.half_length_m = body.half_length_m;
  c.X_WS = X_WP * body.X_PS;
  return c;
}

std::vector<PlacedShape> random_shape(int kind, std::mt19937_64& random) {
  std::uniform_real_distribution<double> size(0.03, 0.3);
  switch (kind) {
    case 0:
      return {{Sphere{size(random)}}};
    case 1:
      return {{Cylinder{size(random), 2 * size(random)}}};
    case 2:
      return {{Box{{size(random), 2 * size(random), 3 * size(random)}}}};
    case 3:
      return {{Box{{2.0, 2.0, 0.1}}}};  // a table
    default:
      return small::capsule_along_x(-size(random), size(random), size(random) / 2);
  }
}

TEST(ConvexShapes, CylinderWithTwoCapsBecomesOneCapsule) {
  const auto bodies = make_convex_shapes(small::capsule_along_x(0.1, 0.5, 0.06));
  ASSERT_EQ(bodies.size(), 1U);
  EXPECT_EQ(bodies[0].kind, ConvexShapeKind::round);
  EXPECT_DOUBLE_EQ(bodies[0].half_length_m, 0.2);
  EXPECT_NEAR(bodies[0].radius_m, 0.06, 1e-12);
}

TEST(ConvexShapes, TwoCylindersThatShareACapBecomeCapsules) {
  auto shapes = small::capsule_along_x(0.0, 0.4, 0.05);
  const auto second = small::capsule_along_x(0.4, 0.7, 0.05);
  shapes.push_back(second[0]);
  shapes.push_back(second[2]);  // only its far end
  const auto bodies = make_convex_shapes(shapes);
  ASSERT_EQ(bodies.size(), 2U);
  for (const ConvexShape& body : bodies) EXPECT_EQ(body.kind, ConvexShapeKind::round);
}

TEST(ConvexShapes, CylinderBecomesACapsuleOnlyIfBothCapsMatch) {
  auto missing = small::capsule_along_x(0.0, 0.4, 0.05);
  missing.pop_back();
  auto thinner = small::capsule_along_x(0.0, 0.4, 0.05);
  thinner[2].shape = Sphere{0.04999};
  auto elsewhere = small::capsule_along_x(0.0, 0.4, 0.05);
  elsewhere[1].X_LS.translation().x() += 1e-5;
  for (const auto& [shapes, count] : {std::pair{missing, 2U}, {thinner, 3U}, {elsewhere, 3U}}) {
    const auto bodies = make_convex_shapes(shapes);
    ASSERT_EQ(bodies.size(), count);
    EXPECT_EQ(bodies[0].kind, ConvexShapeKind::cylinder);
  }
}

TEST(ConvexShapes, CapsuleContainsCapsThatAreAMicrometerOff) {
  auto shapes = small::capsule_along_x(0.0, 0.4, 0.05);
  shapes[1].X_LS.translation().y() = 8e-7;
  const auto bodies = make_convex_shapes(shapes);
  ASSERT_EQ(bodies.size(), 1U);
  EXPECT_GE(bodies[0].radius_m, 0.05 + 8e-7);
}

TEST(ConvexShapes, DistancesAreNeverTooLargeAndRarelyTooSmall) {
  std::mt19937_64 random(20240701);
  std::array<int, 5> apart{};
  int too_small = 0;
  for (int i = 0; i < 20000; ++i) {
    const ConvexShape a = make_convex_shapes(random_shape(i % 5, random)).front();
    const ConvexShape b = make_convex_shapes(random_shape(i / 5 % 5, random)).front();
    const Eigen::Isometry3d X_WA = reference::random_pose(random, 0.4);
    Eigen::Isometry3d X_WB = reference::random_pose(random, 0.4);
    if (i % 3 == 0) X_WB.linear() = X_WA.linear();  // parallel axes and faces
    const reference::Bracket truth = reference::distance(convex(a, X_WA), convex(b, X_WB), 1000);
    if (truth.upper - truth.lower > 1e-7) continue;  // the reference itself did not converge
    PlacedConvexShape at_a;
    PlacedConvexShape at_b;
    place(a, X_WA, at_a);
    place(b, X_WB, at_b);
    const double d = distance_below(a, at_a, b, at_b, 10.0);
    const Bound bound = lower_bound(a, at_a, b, at_b);
    if (truth.upper <= 0.0) {
      EXPECT_LE(d, 1e-8) << "trial " << i;
      EXPECT_LE(bound.distance_m, 1e-8) << "trial " << i;
      continue;
    }
    ++apart[static_cast<std::size_t>(i % 5)];
    EXPECT_LE(d, truth.upper + 1e-9) << "trial " << i;
    const double by_fcl = exact_distance(a, shape_pose(a, at_a), b, shape_pose(b, at_b));
    EXPECT_LE(by_fcl, truth.upper + 1e-9) << "trial " << i;
    EXPECT_GE(by_fcl, truth.lower - 2e-3) << "trial " << i;
    EXPECT_GE(d, truth.lower - 2e-3) << "trial " << i;
    if (d < truth.lower - 2e-7) ++too_small;
    EXPECT_LE(bound.distance_m, truth.upper + 1e-9) << "trial " << i;
    if (bound.exact) {
      EXPECT_DOUBLE_EQ(bound.distance_m, d);
    }
  }
  for (const int count : apart) EXPECT_GT(count, 1000);
  EXPECT_LE(too_small, 2);
}

// An undecided pair costs an exact distance query. A wrong decision may cause a collision.
TEST(Gjk, DecidesNearlyAllPairsAndNoneWrongly) {
  std::mt19937_64 random(20261126);
  int asked = 0;
  int open = 0;
  std::array<int, 3> settled{};  // apart, in contact, enough
  for (int i = 0; i < 4000; ++i) {
    const ConvexShape a = make_convex_shapes(random_shape(i % 5, random)).front();
    const ConvexShape b = make_convex_shapes(random_shape(i / 5 % 5, random)).front();
    const Eigen::Isometry3d X_WA = reference::random_pose(random, 0.4);
    Eigen::Isometry3d X_WB = reference::random_pose(random, 0.4);
    if (i % 3 == 0) X_WB.linear() = X_WA.linear();
    const reference::Bracket truth = reference::distance(convex(a, X_WA), convex(b, X_WB), 1000);
    if (truth.upper - truth.lower > 1e-7) continue;
    PlacedConvexShape at_a;
    PlacedConvexShape at_b;
    place(a, X_WA, at_a);
    place(b, X_WB, at_b);
    const double enough_m = i % 2 == 0 ? 10.0 : 0.05;
    const auto found = gjk(a, at_a, b, at_b, enough_m);
    ++asked;
    if (!found) {
      ++open;
      continue;
    }
    EXPECT_LE(found->distance_m, std::max(truth.upper, 0.0) + 1e-9) << "trial " << i;
    EXPECT_GE(found->distance_m, std::min(enough_m, truth.lower - 2e-7)) << "trial " << i;
    ++settled[found->distance_m == 0.0 ? 1 : found->distance_m < enough_m ? 0 : 2];
  }
  EXPECT_LE(open, asked / 100);
  for (const int count : settled) EXPECT_GE(count, 150);
}

// libccd's GJK reports contact for such boxes, or 20 mm too much.
TEST(ConvexShapes, DistancesOfUprightBoxesAreExact) {
  std::mt19937_64 random(41);
  std::uniform_real_distribution<double> side(0.02, 0.5);
  std::uniform_real_distribution<double> angle(-3.0, 3.0);
  std::uniform_real_distribution<double> place_m(-0.45, 0.45);
  int apart = 0;
  int near = 0;
  for (int i = 0; i < 3000; ++i) {
    // The boxes often have equal heights, like links above one table.
    const double height = i % 3 == 0 ? side(random) : 0.05;
    const ConvexShape a = make_convex_shapes({{Box{{side(random), 0.05, 0.05}}}}).front();
    const ConvexShape b = make_convex_shapes({{Box{{0.02, side(random), height}}}}).front();
    Eigen::Isometry3d X_WA = Eigen::Isometry3d::Identity();
    Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();
    X_WA.rotate(Eigen::AngleAxisd(angle(random), Eigen::Vector3d::UnitZ()));
    X_WB.rotate(Eigen::AngleAxisd(i % 5 == 0 ? 0.0 : angle(random), Eigen::Vector3d::UnitZ()));
    X_WB.translation() = Eigen::Vector3d(place_m(random), place_m(random), 0.0);
    const reference::Bracket truth = reference::distance(convex(a, X_WA), convex(b, X_WB), 1000);
    if (truth.upper - truth.lower > 1e-7) continue;
    PlacedConvexShape at_a;
    PlacedConvexShape at_b;
    place(a, X_WA, at_a);
    place(b, X_WB, at_b);
    const double d = distance_below(a, at_a, b, at_b, 10.0);
    EXPECT_LE(d, std::max(truth.upper, 0.0) + 1e-9) << "trial " << i;
    EXPECT_GE(d, truth.lower - 2e-7) << "trial " << i;
    apart += truth.lower > 0.0 ? 1 : 0;
    near += truth.lower > 0.0 && truth.lower < 0.005 ? 1 : 0;
  }
  EXPECT_GE(apart, 1000);
  EXPECT_GE(near, 15);
}

TEST(ConvexShapes, LinkThatTurnsPastABoxReportsNoFalseContact) {
  std::mt19937_64 random(43);
  std::uniform_real_distribution<double> place_m(0.46, 0.53);
  std::uniform_real_distribution<double> angle(0.2, 0.6);
  const ConvexShape link =
      make_convex_shapes({{Box{{0.5, 0.05, 0.05}}, small::at_xyz(0.25, 0, 0)}}).front();
  const ConvexShape block = make_convex_shapes({{Box{{0.02, 0.02, 0.02}}}}).front();
  int near = 0;
  for (int i = 0; i < 2000; ++i) {
    Eigen::Isometry3d X_WL = Eigen::Isometry3d::Identity();
    X_WL.rotate(Eigen::AngleAxisd(angle(random), Eigen::Vector3d::UnitZ()));
    const Eigen::Isometry3d X_WB = small::at_xyz(place_m(random), 0.2, 0.0);
    const reference::Bracket truth =
        reference::distance(convex(link, X_WL), convex(block, X_WB), 1000);
    if (truth.upper - truth.lower > 1e-7 || truth.lower <= 0.0) continue;
    PlacedConvexShape at_link;
    PlacedConvexShape at_block;
    place(link, X_WL, at_link);
    place(block, X_WB, at_block);
    const double d = distance_below(link, at_link, block, at_block, 1.0);
    EXPECT_LE(d, truth.upper + 1e-9) << "trial " << i;
    EXPECT_GE(d, truth.lower - 2e-7) << "trial " << i;
    near += truth.lower < 0.004 ? 1 : 0;
  }
  EXPECT_GE(near, 30);
}

TEST(ConvexShapes, CapsuleDistancesAgreeWithFcl) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 2000; ++i) {
    const ConvexShape a = make_convex_shapes(random_shape(4, random)).front();
    const ConvexShape b = make_convex_shapes(random_shape(i % 2 == 0 ? 4 : 0, random)).front();
    const Eigen::Isometry3d X_WA = reference::random_pose(random, 0.5);
    const Eigen::Isometry3d X_WB = reference::random_pose(random, 0.5);
    PlacedConvexShape at_a;
    PlacedConvexShape at_b;
    place(a, X_WA, at_a);
    place(b, X_WB, at_b);
    const double by_hand = lower_bound(a, at_a, b, at_b).distance_m;
    const double by_fcl = exact_distance(a, shape_pose(a, at_a), b, shape_pose(b, at_b));
    EXPECT_NEAR(std::max(0.0, by_hand), by_fcl, 1e-9) << "trial " << i;
  }
}

TEST(ConvexShapes, ShapeInsideAnotherIsInContact) {
  const ConvexShape table = make_convex_shapes({{Box{{2.0, 2.0, 1.0}}}}).front();
  const ConvexShape crate = make_convex_shapes({{Box{{0.1, 0.1, 0.1}}}}).front();
  const ConvexShape can = make_convex_shapes({{Cylinder{0.05, 0.1}}}).front();
  const ConvexShape ball = make_convex_shapes({{Sphere{0.05}}}).front();
  PlacedConvexShape at_table;
  place(table, Eigen::Isometry3d::Identity(), at_table);
  for (const ConvexShape& inner : {crate, can, ball}) {
    PlacedConvexShape inside;
    place(inner, small::at_xyz(0.3, 0.2, 0.1), inside);
    EXPECT_LE(distance_below(inner, inside, table, at_table, 1.0), 0.0);
    EXPECT_LE(distance_below(table, at_table, inner, inside, 1.0), 0.0);
  }
}

TEST(ConvexShapes, OverlappingCapsulesHaveANegativeDistance) {
  const ConvexShape a = make_convex_shapes(small::capsule_along_x(-0.2, 0.2, 0.1)).front();
  PlacedConvexShape here;
  PlacedConvexShape above;
  place(a, Eigen::Isometry3d::Identity(), here);
  place(a, small::at_xyz(0, 0, 0.15), above);
  EXPECT_NEAR(distance_below(a, here, a, above, 0.02), -0.05, 1e-12);
}

}  // namespace
}  // namespace armloom
