#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "core/collision/state/body_distance.h"
#include "core/collision/state/clearance_query.h"
#include "core/geometry/surface/enclosure.h"
#include "core/geometry/surface/solid.h"
#include "core/geometry/surface/triangle_distance.h"
#include "test/collision/scaled_query.h"
#include "test/collision/small_cell.h"
#include "test/soundness/concave_meshes.h"
#include "test/soundness/surface_check.h"

namespace armloom::soundness {
namespace {

TEST(Surfaces, DistanceIsNeverOverestimated) {
  const SurfaceReport report = check_surfaces(6'000, 51);
  EXPECT_EQ(report.too_far, 0U) << "by up to " << report.worst_m << " m";
  for (const std::string& failure : report.failures) ADD_FAILURE() << failure;
  std::printf(
      "%zu pairs, %zu apart, %zu in contact (%zu inside), %zu opened, %zu false contacts, "
      "shortfall %.3g m, to round shapes %.3g m\n",
      report.pairs, report.apart, report.in_contact, report.inside, report.opened,
      report.false_contacts, report.shortfall_m, report.round_shortfall_m);
  EXPECT_GE(report.apart, 1'000U);
  EXPECT_GE(report.in_contact, 1'000U);
  EXPECT_GE(report.inside, 50U);
  EXPECT_GE(report.opened, 50U);  // otherwise only the pieces were tested
  EXPECT_EQ(report.false_contacts, 0U);
  EXPECT_LE(report.shortfall_m, 1e-7);
}

TEST(Surfaces, EnclosePointsInside) {
  std::mt19937_64 random(52);
  std::size_t enclosed = 0;
  std::size_t outside = 0;
  std::size_t wrongly = 0;
  for (int i = 0; i < 150; ++i) {
    const MeshPtr mesh = concave_mesh({1.0, i % 2 == 0 ? 0.0 : 0.2, i % 3 == 0}, random);
    const MeshPtr turned = turned_over(*mesh, random);
    const auto components = components_of(*mesh);
    for (int k = 0; k < 40; ++k) {
      Eigen::Vector3d p(between(random, -0.5, 0.5), between(random, -0.5, 0.5),
                        between(random, -0.5, 0.5));
      if (k % 4 == 0) p = 0.5 * (p + mesh->vertices[random() % mesh->vertices.size()]);
      const bool inside = winds_about(*mesh, components, p);
      ++(inside ? enclosed : outside);
      ASSERT_EQ(may_enclose(*mesh->surface, p), inside) << "mesh " << i << ", point " << k;
      if (inside) {
        ASSERT_TRUE(may_enclose(*turned->surface, p)) << "mesh " << i << ", point " << k;
      } else if (may_enclose(*turned->surface, p)) {
        ++wrongly;
      }
    }
  }
  EXPECT_GE(enclosed, 1'000U);
  EXPECT_GE(outside, 1'000U);
  EXPECT_LE(wrongly, outside / 20);
}

TEST(Surfaces, EnclosePointsThatTheyWindAroundTwice) {
  std::mt19937_64 random(54);
  const MeshPtr mesh = twice_wound_mesh();
  const auto components = components_of(*mesh);
  int twice = 0;
  int outside = 0;
  for (int k = 0; k < 2'000; ++k) {
    const Eigen::Vector3d p(between(random, -0.3, 0.3), between(random, -0.3, 0.3),
                            between(random, -0.3, 0.3));
    const bool inside = winds_about(*mesh, components, p);
    ASSERT_EQ(may_enclose(*mesh->surface, p), inside) << "point " << k;
    if (p.head<2>().norm() < 0.12 && std::abs(p.z()) < 0.2) {
      ASSERT_TRUE(inside);
      ++twice;
    }
    if (!inside) ++outside;
  }
  EXPECT_GE(twice, 100);
  EXPECT_GE(outside, 500);
}

TEST(Surfaces, CloserThanAgreesWithTheDistance) {
  std::mt19937_64 random(53);
  int closer = 0;
  for (int i = 0; i < 60; ++i) {
    const Solid a{concave_mesh({0.3, 0.1, false}, random)->surface};
    const Solid b{concave_mesh({0.2, 0.1, false}, random)->surface, Eigen::Isometry3d::Identity(),
                  i % 2 == 0 ? 0.0 : 0.01};
    for (int k = 0; k < 20; ++k) {
      const Eigen::Isometry3d X_WA = Eigen::Isometry3d::Identity();
      Eigen::Isometry3d X_WB = X_WA;
      X_WB.translation() =
          Eigen::Vector3d(between(random, -0.4, 0.4), between(random, -0.4, 0.4), 0.1);
      const double distance = solid_distance({a, X_WA}, {b, X_WB}, 10.0);
      for (const double limit : {1e-9, 0.02, 0.1}) {
        ASSERT_EQ(closer_than({a, X_WA}, {b, X_WB}, limit), distance < limit);
        if (distance < limit) ++closer;
      }
    }
  }
  EXPECT_GE(closer, 500);
}

TEST(Surfaces, RoughDistanceIsWithinItsTolerance) {
  std::mt19937_64 random(54);
  constexpr Roughness kRough{0.02, 0.01};
  int rough = 0;
  int exact = 0;
  for (int i = 0; i < 60; ++i) {
    const Solid a{concave_mesh({0.3, 0.1, false}, random)->surface};
    const Solid b{concave_mesh({0.2, 0.1, false}, random)->surface, Eigen::Isometry3d::Identity(),
                  i % 2 == 0 ? 0.0 : 0.01};
    for (int k = 0; k < 20; ++k) {
      const Eigen::Isometry3d X_WA = Eigen::Isometry3d::Identity();
      Eigen::Isometry3d X_WB = X_WA;
      X_WB.translation() =
          Eigen::Vector3d(between(random, -0.4, 0.4), between(random, -0.4, 0.4), 0.1);
      const double distance = solid_distance({a, X_WA}, {b, X_WB}, 10.0);
      const double told = solid_distance({a, X_WA}, {b, X_WB}, 10.0, kRough);
      ASSERT_LE(told, distance + 1e-9);
      ASSERT_GE(told, distance - kRough.by_m - 1e-9);
      ASSERT_EQ(told < kRough.exact_below_m, distance < kRough.exact_below_m);
      if (distance < kRough.exact_below_m) {
        ASSERT_NEAR(told, distance, 1e-9);
        exact += distance > 0.0 ? 1 : 0;
      } else if (told < distance - 1e-6) {
        ++rough;
      }
    }
  }
  EXPECT_GE(rough, 100);
  EXPECT_GE(exact, 20);
}

TEST(InnerBalls, ProveMostOverlapsAndNothingElse) {
  std::mt19937_64 random(55);
  const Eigen::Isometry3d X_WA = Eigen::Isometry3d::Identity();
  std::size_t proven = 0;
  std::size_t wrongly = 0;
  std::size_t overlaps = 0;
  for (int i = 0; i < 100; ++i) {
    const auto solid = [&](double size_m) {
      const SurfaceTreePtr surface = concave_mesh({size_m, i % 2 * 0.2, false}, random)->surface;
      return Solid{surface, X_WA, 0.0, InnerBalls(inner_balls(*surface))};
    };
    const Solid a = solid(0.3);
    const Solid b = solid(0.3);
    for (int k = 0; k < 60; ++k) {
      Eigen::Isometry3d X_WB = X_WA;
      X_WB.linear() = Eigen::Quaterniond(between(random, -1, 1), between(random, -1, 1),
                                         between(random, -1, 1), between(random, -1, 1))
                          .normalized()
                          .toRotationMatrix();
      X_WB.translation() = Eigen::Vector3d(between(random, -0.4, 0.4), between(random, -0.2, 0.2),
                                           between(random, -0.2, 0.2));
      const double limit_m = k % 3 == 0 ? 1e-9 : 0.02;
      const bool closer =
          solid_distance({Solid{a.tree}, X_WA}, {Solid{b.tree}, X_WB}, limit_m) < limit_m;
      const bool by_balls = surely_closer_than({a, X_WA}, {b, X_WB}, limit_m);
      overlaps += closer ? 1 : 0;
      proven += by_balls ? 1 : 0;
      wrongly += by_balls && !closer ? 1 : 0;
    }
  }
  std::printf("%zu of %zu proven by balls\n", proven, overlaps);
  EXPECT_EQ(wrongly, 0U);
  EXPECT_GE(overlaps, 1'000U);
  EXPECT_GE(proven, overlaps / 3);
}

void expect_the_closest(small::ScaledQuery& checker, const Configuration& q) {
  constexpr double kHorizon_m = kSurfaceWithin_m;  // larger distances may be of pieces
  const std::vector<NearPair> near = checker.near(q, kHorizon_m);
  double least_m = kHorizon_m;
  for (const NearPair& pair : near) {
    if (!checker.is_self(pair.pair)) least_m = std::min(least_m, pair.clearance_m);
  }
  double closest_m = kHorizon_m;
  const auto [apart, at_mount] = checker.closest_apart(q, kHorizon_m);
  for (const auto* pairs : {&apart, &at_mount}) {
    for (const Proximity& pair : *pairs) closest_m = std::min(closest_m, pair.clearance_m);
  }
  EXPECT_NEAR(std::max(closest_m, 0.0), std::max(least_m, 0.0), 1e-9);
}

// Eight states at once, inner balls first.
TEST(Surfaces, StateChecksAgreeWithDistances) {
  std::mt19937_64 random(56);
  std::size_t close = 0;
  std::size_t clear = 0;
  for (int i = 0; i < 10; ++i) {
    Cell made;
    made.clearances.clearance_m = 0.02;
    made.clearances.self_clearance_m = 0.005;
    const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
    small::add_robot(made, "a", small::at_xyz(0, 0, 0), {z, Eigen::Vector3d::UnitY(), z},
                     {0.3, 0.03});
    small::add_robot(made, "b", small::at_xyz(0.45, 0, 0), {z, Eigen::Vector3d::UnitY(), z},
                     {0.3, 0.03});
    for (Link& link : made.links) {
      if (!link.arm) continue;
      const MeshPtr mesh = concave_mesh({0.25, 0.1, false}, random);
      link.shapes.assign(
          1, {Mesh{"by hand", Eigen::Vector3d::Ones(), mesh}, small::at_xyz(0.15, 0, 0)});
    }
    const CellPtr cell = small::shared(made);
    const PlanningScenePtr scene = PlanningScene::build(cell).value();
    ClearanceQuery check(scene);
    small::ScaledQuery checker(scene);
    for (int k = 0; k < 25; ++k) {
      std::vector<Configuration> states(8, Configuration::Zero(6));
      std::vector<const Configuration*> eight;
      for (Configuration& q : states) {
        for (double& angle : q) angle = between(random, -2.5, 2.5);
        eight.push_back(&q);
      }
      const unsigned too_close = check.too_close(eight);
      for (std::size_t lane = 0; lane < states.size(); ++lane) {
        const bool by_pairs =
            checker.first_closer_than(states[lane], cell->clearances.clearance_m, {true, true})
                .has_value();
        ASSERT_EQ((too_close >> lane & 1U) != 0, by_pairs) << "cell " << i << ", states " << k;
        if (lane == 0) expect_the_closest(checker, states[lane]);
        ++(by_pairs ? close : clear);
      }
    }
  }
  EXPECT_GE(close, 150U);
  EXPECT_GE(clear, 150U);
}

// Compares with samples, which are never closer than the triangles.
TEST(Triangles, DistanceIsNeverOverestimated) {
  std::mt19937_64 random(54);
  double shortfall = 0.0;
  const auto corner = [&] {
    // Often on a grid: parallel edges, coplanar faces, coinciding corners.
    const bool round = random() % 2 == 0;
    Eigen::Vector3d p(between(random, -1, 1), between(random, -1, 1), between(random, -1, 1));
    return round ? Eigen::Vector3d((2.0 * p).array().round() / 2.0) : p;
  };
  for (int i = 0; i < 20'000; ++i) {
    TrianglePoints a{corner(), corner(), corner()};
    TrianglePoints b{corner(), corner(), corner()};
    if (i % 5 == 0) a[2] = a[1];                  // a segment
    if (i % 7 == 0) b[2] = b[1] = b[0];           // a point
    if (i % 11 == 0) a[2] = 0.5 * (a[0] + a[1]);  // no area
    if (i % 3 == 0) {
      for (auto& p : b) p += Eigen::Vector3d(0, 0, 1.5);
    }
    const double said = triangle_distance(a, b, 10.0);
    ASSERT_EQ(triangle_distance(a, b, 0.5 * said), 0.5 * said);
    double least = 1e9;
    const auto at = [](const TrianglePoints& t, int u, int v) -> Eigen::Vector3d {
      return t[0] + u / 6.0 * (t[1] - t[0]) + v / 6.0 * (t[2] - t[0]);
    };
    for (int u = 0; u <= 6; ++u) {
      for (int v = 0; u + v <= 6; ++v) {
        const Eigen::Vector3d p = at(a, u, v);
        for (int s = 0; s <= 6; ++s) {
          for (int t = 0; s + t <= 6; ++t) least = std::min(least, (p - at(b, s, t)).norm());
        }
      }
    }
    ASSERT_LE(said, least + 1e-12) << i;
    if (i % 5 == 0 || i % 7 == 0 || i % 11 == 0) continue;
    const double by_fcl = triangles_by_fcl(a, b);
    ASSERT_LE(said, by_fcl + 1e-9) << i;
    shortfall = std::max(shortfall, by_fcl - said);
  }
  EXPECT_LE(shortfall, 1e-7);
}

}  // namespace
}  // namespace armloom::soundness
