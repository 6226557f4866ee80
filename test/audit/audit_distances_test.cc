// Compares audit distances of all kinds of shapes with reference_distance.h, also in planes in
// which GJK is known to fail.
#include <gmock/gmock.h>

#include <algorithm>
#include <random>
#include <vector>

#include "core/audit/audit.h"
#include "test/collision/small_cell.h"
#include "test/geometry/reference_distance.h"
#include "test/geometry/small_meshes.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;
using reference::Convex;

constexpr double kTolerance_m = 1e-4;

enum class Kind { box, cylinder, sphere, box_mesh, channel_mesh };
constexpr Kind kKinds[] = {Kind::box, Kind::cylinder, Kind::sphere, Kind::box_mesh,
                           Kind::channel_mesh};

// A shape, and the convex parts that it consists of.
struct Sample {
  Shape shape;
  std::vector<Convex> parts;
};

Convex box_at(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  Convex box{Convex::Kind::box, 0.5 * (high - low)};
  box.X_WS.translation() = 0.5 * (low + high);
  return box;
}

Sample sample(Kind kind, std::mt19937_64& random) {
  std::uniform_real_distribution<double> size(0.01, 0.2);
  const Eigen::Vector3d half(size(random), size(random), size(random));
  switch (kind) {
    case Kind::box:
      return {Box{2 * half}, {box_at(-half, half)}};
    case Kind::cylinder: {
      Convex cylinder{Convex::Kind::cylinder};
      cylinder.radius_m = half.x();
      cylinder.half_length_m = half.y();
      return {Cylinder{half.x(), 2 * half.y()}, {cylinder}};
    }
    case Kind::sphere: {
      Convex sphere{Convex::Kind::capsule};
      sphere.radius_m = half.x();
      return {Sphere{half.x()}, {sphere}};
    }
    case Kind::box_mesh: {
      // One face is split into a fan of triangles. Two of its triangles have no area.
      small::Surface surface = small::box_surface(-half, half);
      surface.triangles.push_back({0, 1, 1});
      surface.vertices.emplace_back(0.5 * (surface.vertices[0] + surface.vertices[1]));
      surface.triangles.push_back({0, 8, 1});
      return {small::mesh_of(surface), {box_at(-half, half)}};
    }
    case Kind::channel_mesh:
      break;
  }
  const double s = 0.25 * size(random);
  return {small::mesh_of(small::channel(2 * s)),
          {box_at({-0.5, -0.5, 0}, {-s, 0.5, 1}), box_at({s, -0.5, 0}, {0.5, 0.5, 1}),
           box_at({-0.5, -0.5, -0.1}, {0.5, 0.5, 0})}};
}

double true_distance(const Sample& a, const Eigen::Isometry3d& X_WA, const Sample& b,
                     const Eigen::Isometry3d& X_WB) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const Convex& in_a : a.parts) {
    for (const Convex& in_b : b.parts) {
      Convex x = in_a;
      Convex y = in_b;
      x.X_WS = X_WA * x.X_WS;
      y.X_WS = X_WB * y.X_WS;
      const reference::Bracket found = reference::distance(x, y, 4000);
      if (found.upper - found.lower > 1e-5) return -1.0;  // the reference did not converge
      smallest = std::min(smallest, found.upper);
    }
  }
  return smallest;
}

// If `upright`, the shapes are rotated about z only and are at equal heights.
Eigen::Isometry3d place(std::mt19937_64& random, bool upright) {
  Eigen::Isometry3d X = reference::random_pose(random, 0.5);
  if (!upright) return X;
  const double turn = std::uniform_real_distribution<double>(-3, 3)(random);
  X.linear() = Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  X.translation().z() = 0;
  return X;
}

TEST(AuditDistances, MatchReferenceToATenthOfAMillimeter) {
  std::mt19937_64 random(11);
  int near = 0;
  int touching = 0;
  for (const Kind kind_a : kKinds) {
    for (const Kind kind_b : kKinds) {
      for (int round = 0; round < 120; ++round) {
        const Sample a = sample(kind_a, random);
        const Sample b = sample(kind_b, random);
        const bool upright = round % 2 == 0;
        const Eigen::Isometry3d X_WA = place(random, upright);
        const Eigen::Isometry3d X_WB = place(random, upright);
        const double distance_m = true_distance(a, X_WA, b, X_WB);
        if (distance_m < 0.0 || (distance_m > 0.0 && distance_m < kTolerance_m)) continue;
        Cell cell;
        small::add_robot(cell, "a", X_WA, {Eigen::Vector3d::UnitZ()}, {0.4, 0.03});
        cell.links[1].shapes.clear();
        small::add_shape(cell.links[1], a.shape, Eigen::Isometry3d::Identity());
        cell.objects.push_back({"part", b.shape, X_WB});
        const auto report = audit(cell, {{at(0ms), Configuration::Zero(1)}}, 10ms);
        ASSERT_TRUE(report && report->smallest_clearance);
        const std::string where = std::to_string(static_cast<int>(kind_a)) + " and " +
                                  std::to_string(static_cast<int>(kind_b)) + ", round " +
                                  std::to_string(round);
        EXPECT_NEAR(report->smallest_clearance->distance_m, distance_m, kTolerance_m) << where;
        EXPECT_EQ(report->first_contact.has_value(), distance_m <= 0.0) << where;
        ++(distance_m > 0.0 ? near : touching);
      }
    }
  }
  EXPECT_GE(near, 1000);
  EXPECT_GE(touching, 200);
}

}  // namespace
}  // namespace armloom
