// Compares claimed separations, for any deviation of the carrying joints, with shapes that really
// moved.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/collision/diagram/body_sweep.h"
#include "core/collision/scene/scene_bodies.h"
#include "core/geometry/convex/exact_distance.h"
#include "core/geometry/mesh/mesh.h"
#include "test/soundness/pairs.h"

namespace armloom::soundness {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kRounding_m = 1e-6;  // exact_distance() may be too small by this much

Vector3d any_vector(std::mt19937_64& random, double size) {
  return {uniform(random, -size, size), uniform(random, -size, size), uniform(random, -size, size)};
}

Vector3d any_direction(std::mt19937_64& random) {
  for (;;) {
    const Vector3d v = any_vector(random, 1.0);
    if (v.norm() > 0.1 && v.norm() < 1.0) return v.normalized();
  }
}

Isometry3d any_pose(std::mt19937_64& random, const Vector3d& at) {
  Isometry3d X = Isometry3d::Identity();
  X.linear() = Eigen::AngleAxisd(uniform(random, 0.0, 3.1), any_direction(random)).matrix();
  X.translation() = at;
  return X;
}

// Up to seven joints, mostly revolute.
std::vector<MovingAxis> any_axes(std::mt19937_64& random, double span_max) {
  std::vector<MovingAxis> axes(random() % 8);
  const bool drift = random() % 2 == 0;
  for (MovingAxis& axis : axes) {
    axis = {any_direction(random), any_vector(random, 0.7), uniform(random, 0.0, span_max),
            random() % 5 == 0};
    if (drift)
      axis.drift = uniform(random, -1.0, 1.0) * std::exchange(axis.loose, 0.1 * axis.loose);
  }
  return axes;
}

// Returns how a body moves if each joint deviates by its share of `loose`, and by the last share of
// its drift.
Isometry3d moved(const std::vector<MovingAxis>& axes, const std::vector<double>& share) {
  Isometry3d E = Isometry3d::Identity();
  for (std::size_t j = 0; j < axes.size(); ++j) {
    const MovingAxis& axis = axes[j];
    const double off = share[j] * axis.loose + share.back() * axis.drift;
    if (axis.prismatic) {
      E.translate(Vector3d(off * axis.z_W));
    } else {
      E.translate(axis.p_WO);
      E.rotate(Eigen::AngleAxisd(off, axis.z_W));
      E.translate(Vector3d(-axis.p_WO));
    }
  }
  return E;
}

std::vector<ConvexShape> any_body(std::mt19937_64& random) {
  const auto size = [&] { return uniform(random, 0.02, 0.2); };
  std::vector<PlacedShape> shapes;
  switch (random() % 4) {
    case 0:
      shapes.push_back({Box{Vector3d(size(), size(), size())}});
      break;
    case 1:
      shapes.push_back({Cylinder{0.5 * size(), size()}});
      break;
    case 2: {  // a capsule
      const Cylinder cylinder{0.5 * size(), size()};
      shapes.push_back({cylinder});
      for (const double end : {-0.5, 0.5}) {
        shapes.push_back({Sphere{cylinder.radius_m}});
        shapes.back().X_LS.translation().z() = end * cylinder.length_m;
      }
      break;
    }
    default:
      shapes.push_back({Sphere{size()}});
      break;
  }
  return make_convex_shapes(shapes);
}

struct Two {
  ConvexShape a, b;
  Isometry3d X_WA, X_WB;
  std::vector<MovingAxis> axes_a, axes_b;

  Two(std::mt19937_64& random, double span_max)
      : a(any_body(random).front()),
        b(any_body(random).front()),
        X_WA(any_pose(random, any_vector(random, 0.2))),
        X_WB(any_pose(random,
                      X_WA.translation() + uniform(random, 0.2, 0.5) * any_direction(random))),
        axes_a(any_axes(random, span_max)),
        axes_b(any_axes(random, span_max)) {}

  [[nodiscard]] std::optional<double> claim() const {
    PlacedConvexShape at_a, at_b;
    place(a, X_WA, at_a);
    place(b, X_WB, at_b);
    const auto apart = separation(a, at_a, b, at_b, 10.0);
    if (!apart) return std::nullopt;
    return swept_gap({a, at_a, axes_a}, {b, at_b, axes_b}, apart->n_W);
  }

  [[nodiscard]] double distance(const std::vector<double>& share_a,
                                const std::vector<double>& share_b) const {
    PlacedConvexShape at_a, at_b;
    place(a, moved(axes_a, share_a) * X_WA, at_a);
    place(b, moved(axes_b, share_b) * X_WB, at_b);
    return distance_below(a, at_a, b, at_b, 10.0);
  }
};

std::vector<double> any_share(std::mt19937_64& random, std::size_t joints) {
  std::vector<double> share(joints + 1);
  const bool corner = random() % 2 == 0;
  for (double& s : share) {
    s = corner ? (random() % 2 == 0 ? -1.0 : 1.0) : uniform(random, -1.0, 1.0);
  }
  return share;
}

double closest(const Two& two, std::mt19937_64& random) {
  double closest_m = 10.0;
  for (int i = 0; i < 6; ++i) {
    auto share_a = any_share(random, two.axes_a.size());
    auto share_b = any_share(random, two.axes_b.size());
    double here_m = two.distance(share_a, share_b);
    for (std::vector<double>* share : {&share_a, &share_b}) {
      for (double& s : *share) {
        const double before = s;
        double best = s;
        for (const double tried : {-1.0, 1.0}) {
          s = tried;
          const double found_m = two.distance(share_a, share_b);
          if (found_m < here_m) {
            here_m = found_m;
            best = tried;
          }
        }
        s = best == before ? before : best;
      }
    }
    closest_m = std::min(closest_m, here_m);
  }
  return closest_m;
}

struct Tally {
  std::size_t claims = 0;
  std::size_t undercut = 0;
  double loss_m = 0.0;  // sum of (closest distance found - claim)
};
Tally attack(std::size_t pairs, double span_max, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Tally tally;
  for (std::size_t i = 0; i < pairs; ++i) {
    const Two two(random, span_max);
    const auto claim_m = two.claim();
    if (!claim_m || *claim_m <= 0.0) continue;
    const double closest_m = closest(two, random);
    ++tally.claims;
    tally.loss_m += closest_m - *claim_m;
    if (closest_m < *claim_m - kRounding_m) {
      ++tally.undercut;
      ADD_FAILURE() << "pair " << i << ": " << *claim_m << " m claimed, " << closest_m;
    }
  }
  return tally;
}

TEST(Sweeps, AreSoundAndTightForSmallDeviations) {
  const Tally tally = attack(4000, 0.001, 41);
  EXPECT_GE(tally.claims, 2000U);
  EXPECT_EQ(tally.undercut, 0U);
  // A bound by levers would lose about 2.5 mm.
  EXPECT_LE(tally.loss_m / static_cast<double>(tally.claims), 0.0001);
}

TEST(Sweeps, AreSoundForLargeDeviations) {
  EXPECT_GE(attack(4000, 0.05, 42).claims, 1000U);
  EXPECT_GE(attack(8000, 0.3, 43).claims, 200U);
}

TEST(Sweeps, AreSoundForSurfaces) {
  std::mt19937_64 random(44);
  std::size_t said = 0;
  for (int i = 0; i < 120; ++i) {
    const Two two(random, 0.01);
    const Solid& a = *two.a.solid;
    const Solid& b = *two.b.solid;
    const double limit_m = uniform(random, 0.001, 0.1);
    const MovingSolid moving_a{{a, two.X_WA * a.X_PT}, two.axes_a};
    const MovingSolid moving_b{{b, two.X_WB * b.X_PT}, two.axes_b};
    if (solid_distance(moving_a.at, moving_b.at, limit_m) < limit_m) continue;
    if (!surfaces_keep_apart(moving_a, moving_b, limit_m, 10.0)) continue;
    ++said;
    for (int k = 0; k < 10; ++k) {
      const Isometry3d X_WA = moved(two.axes_a, any_share(random, two.axes_a.size())) * two.X_WA;
      const Isometry3d X_WB = moved(two.axes_b, any_share(random, two.axes_b.size())) * two.X_WB;
      ASSERT_GE(solid_distance({a, X_WA * a.X_PT}, {b, X_WB * b.X_PT}, 1.0), limit_m - kRounding_m);
    }
  }
  EXPECT_GE(said, 20U);  // a sixth
}

}  // namespace
}  // namespace armloom::soundness
