#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "core/collision/enclosure.h"
#include "core/collision/solid.h"
#include "core/collision/triangle_distance.h"
#include "test/soundness/concave_meshes.h"
#include "test/soundness/surface_check.h"

namespace armloom::soundness {
namespace {

TEST(Surfaces, AreNeverSaidToBeFartherApartThanTheyAre) {
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
  EXPECT_GE(report.opened, 50U);  // else the pieces alone have been tested
  EXPECT_EQ(report.false_contacts, 0U);
  EXPECT_LE(report.shortfall_m, 1e-7);
}

TEST(Surfaces, EncloseWhatTheyWindAbout) {
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

// Pairs that come closer than a limit are found whether or not the distance is asked for.
TEST(Surfaces, AreCloserThanALimitWhenTheirDistanceIs) {
  std::mt19937_64 random(53);
  int closer = 0;
  for (int i = 0; i < 60; ++i) {
    const Solid a{concave_mesh({0.3, 0.1, false}, random)->surface};
    const Solid b{concave_mesh({0.2, 0.1, false}, random)->surface, Eigen::Isometry3d::Identity(),
                  i % 2 == 0 ? 0.0 : 0.01};
    for (int k = 0; k < 20; ++k) {
      Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
      X.translation() =
          Eigen::Vector3d(between(random, -0.4, 0.4), between(random, -0.4, 0.4), 0.1);
      const double distance = solid_distance(a, Eigen::Isometry3d::Identity(), b, X, 10.0);
      for (const double limit : {1e-9, 0.02, 0.1}) {
        ASSERT_EQ(closer_than(a, Eigen::Isometry3d::Identity(), b, X, limit), distance < limit);
        if (distance < limit) ++closer;
      }
    }
  }
  EXPECT_GE(closer, 500);
}

// By samples of both, which are never closer than they are.
TEST(Triangles, AreNeverSaidToBeFartherApartThanTheyAre) {
  std::mt19937_64 random(54);
  double shortfall = 0.0;
  const auto corner = [&] {
    // Often on a grid: parallel edges, faces in one plane, corners that coincide.
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
