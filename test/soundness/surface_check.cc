#include "test/soundness/surface_check.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

#include "core/collision/state/body_distance.h"
#include "test/soundness/concave_meshes.h"

namespace armloom::soundness {
namespace {

using Model = fcl::BVHModel<fcl::OBBRSSd>;

constexpr double kFclRounding_m = 1e-9;  // of FCL's distances of triangles
constexpr double kLimit_m = 0.1;

struct Shown {
  std::vector<ConvexShape> shapes;
  CollisionBody body;
  MeshPtr mesh;  // reference; of a primitive an inscribed mesh
  std::vector<std::uint32_t> components;
  std::shared_ptr<Model> model;
  bool is_mesh = true;
};

std::shared_ptr<Model> model_of(const MeshData& mesh) {
  auto model = std::make_shared<Model>();
  std::vector<fcl::Triangle> triangles;
  for (const Triangle& t : mesh.triangles) triangles.emplace_back(t[0], t[1], t[2]);
  model->beginModel();
  model->addSubModel(mesh.vertices, triangles);
  model->endModel();
  model->computeLocalAABB();
  return model;
}

// Returns points on the primitive's surface; their hull is inscribed.
std::vector<Eigen::Vector3d> points_of(const std::vector<PlacedShape>& shapes) {
  std::vector<Eigen::Vector3d> points;
  constexpr int kAround = 16;  // more corners would be simplified
  for (const PlacedShape& placed : shapes) {
    const auto add = [&](double x, double y, double z) {
      points.emplace_back(placed.X_LS * Eigen::Vector3d(x, y, z));
    };
    if (const auto* box = std::get_if<Box>(&placed.shape)) {
      for (int i = 0; i < 8; ++i) {
        const Eigen::Vector3d half = 0.5 * box->size_m;
        add(i & 1 ? half.x() : -half.x(), i & 2 ? half.y() : -half.y(),
            i & 4 ? half.z() : -half.z());
      }
    } else if (const auto* cylinder = std::get_if<Cylinder>(&placed.shape)) {
      for (int i = 0; i < kAround; ++i) {
        const double turn = 2.0 * std::numbers::pi * i / kAround;
        for (const double z : {-0.5, 0.5}) {
          add(cylinder->radius_m * std::cos(turn), cylinder->radius_m * std::sin(turn),
              z * cylinder->length_m);
        }
      }
    } else {
      const double radius = std::get<Sphere>(placed.shape).radius_m;
      for (int k = 0; k <= kAround / 2; ++k) {
        const double tilt = std::numbers::pi * k / (kAround / 2.0);
        for (int i = 0; i < kAround; ++i) {
          const double turn = 2.0 * std::numbers::pi * i / kAround;
          add(radius * std::sin(tilt) * std::cos(turn), radius * std::sin(tilt) * std::sin(turn),
              radius * std::cos(tilt));
        }
      }
    }
  }
  return points;
}

std::vector<PlacedShape> random_primitive(double size_m, std::mt19937_64& random) {
  const double r = 0.5 * size_m * between(random, 0.2, 0.7);
  Eigen::Isometry3d end = Eigen::Isometry3d::Identity();
  end.translation().z() = r;
  switch (random() % 4) {
    case 0:
      return {{Box{{r, 2.0 * r, between(random, 0.1, 3.0) * r}}}};
    case 1:
      return {{Cylinder{r, 3.0 * r}}};
    case 2:
      return {{Sphere{r}}};
    default:
      return {{Cylinder{r, 2.0 * r}}, {Sphere{r}, end}, {Sphere{r}, end.inverse()}};
  }
}

Shown show(bool primitive, double size_m, std::mt19937_64& random) {
  Shown made;
  std::vector<PlacedShape> shapes;
  if (primitive) {
    shapes = random_primitive(size_m, random);
    auto inscribed = std::make_shared<MeshData>();
    const ConvexHull hull = convex_hull(points_of(shapes)).value();
    inscribed->vertices = hull.vertices;
    inscribed->triangles = hull.faces;
    made.mesh = std::move(inscribed);
    made.is_mesh = false;
  } else {
    const double noise = random() % 2 == 0 ? 0.0 : between(random, 0.0, 0.25);
    made.mesh = concave_mesh({size_m, noise, random() % 6 == 0}, random);
    const bool turned = random() % 5 == 0;
    shapes = {{Mesh{"by hand", Eigen::Vector3d::Ones(),
                    turned ? turned_over(*made.mesh, random) : made.mesh}}};
  }
  made.shapes = make_convex_shapes(shapes);
  made.body.shapes_end = made.shapes.size();
  made.components = components_of(*made.mesh);
  made.model = model_of(*made.mesh);
  return made;
}

Eigen::Isometry3d random_turn(std::mt19937_64& random) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  if (random() % 4 == 0) return X;  // keeps faces parallel
  const Eigen::Vector3d axis(between(random, -1, 1), between(random, -1, 1),
                             between(random, -1, 1));
  X.linear() = Eigen::AngleAxisd(between(random, -3.0, 3.0),
                                 (axis + Eigen::Vector3d(0, 0, 1e-3)).normalized())
                   .toRotationMatrix();
  return X;
}

double surfaces_m(const Shown& a, const Eigen::Isometry3d& X_WA, const Shown& b,
                  const Eigen::Isometry3d& X_WB) {
  fcl::DistanceRequestd request;
  fcl::DistanceResultd result;
  const double d = fcl::distance<double>(a.model.get(), X_WA, b.model.get(), X_WB, request, result);
  return std::max(0.0, d);
}

// For surfaces that do not touch: returns true if a component of the inner mesh is inside the outer
// mesh.
bool holds(const Shown& outer, const Shown& inner, const Eigen::Isometry3d& X_OI) {
  for (std::size_t i = 0; i < inner.components.size(); ++i) {
    if (inner.components[i] != i) continue;
    if (winds_about(*outer.mesh, outer.components, X_OI * inner.mesh->vertices[i])) return true;
  }
  return false;
}

class Checker {
 public:
  explicit Checker(std::uint64_t seed) : random_(seed) {
    for (std::size_t i = 0; i < kSolids; ++i) {
      large_.push_back(show(false, 0.4, random_));
      middle_.push_back(show(i % 4 == 0, 0.3, random_));
      small_.push_back(show(i % 4 == 0, 0.06, random_));
    }
  }

  void check() {
    const bool small_one = random_() % 2 == 0;
    const Shown& a = large_[random_() % kSolids];
    const Shown& b = (small_one ? small_ : middle_)[random_() % kSolids];
    const Eigen::Isometry3d X_WA = random_turn(random_);
    for (int placing = 0; placing < 4; ++placing) {
      Eigen::Isometry3d X_WB = random_turn(random_);
      const Eigen::Vector3d way(between(random_, -1, 1), between(random_, -1, 1),
                                between(random_, -1, 1));
      X_WB.translation() = between(random_, 0.0, small_one ? 0.3 : 0.45) * way.normalized();
      hold(a, X_WA, b, X_WB);
    }
  }

  SurfaceReport report;

 private:
  void hold(const Shown& a, const Eigen::Isometry3d& X_WA, const Shown& b,
            const Eigen::Isometry3d& X_WB) {
    ++report.pairs;
    double truth_m = surfaces_m(a, X_WA, b, X_WB);
    if (truth_m > 0.0) {
      const Eigen::Isometry3d X_AB = X_WA.inverse() * X_WB;
      if (holds(a, b, X_AB) || holds(b, a, X_AB.inverse())) {
        truth_m = 0.0;
        ++report.inside;
      }
    }
    ++(truth_m > 0.0 ? report.apart : report.in_contact);
    const double said_m = distance(a, X_WA, b, X_WB, 1e3);
    compare(said_m, truth_m, a, b, "the distance");
    const double below_m = distance(a, X_WA, b, X_WB, kLimit_m);
    if (below_m != std::min(said_m, kLimit_m)) {
      compare(below_m, std::min(truth_m, kLimit_m), a, b, "the distance below a limit");
    }
    if (truth_m > 1e-3 && a.is_mesh && b.is_mesh && pieces_m(a, X_WA, b, X_WB) < 1e-3) {
      ++report.opened;
    }
  }

  static double distance(const Shown& a, const Eigen::Isometry3d& X_WA, const Shown& b,
                         const Eigen::Isometry3d& X_WB, double limit_m) {
    std::vector<ConvexShape> shapes = a.shapes;
    shapes.insert(shapes.end(), b.shapes.begin(), b.shapes.end());
    CollisionBody body_b = b.body;
    body_b.shapes_begin += a.shapes.size();
    body_b.shapes_end += a.shapes.size();
    return body_distance(shapes, {a.body, X_WA}, {body_b, X_WB}, limit_m);
  }

  static double pieces_m(const Shown& a, const Eigen::Isometry3d& X_WA, const Shown& b,
                         const Eigen::Isometry3d& X_WB) {
    double least = 1e3;
    for (const ConvexShape& shape_a : a.shapes) {
      for (const ConvexShape& shape_b : b.shapes) {
        PlacedConvexShape at_a;
        PlacedConvexShape at_b;
        place(shape_a, X_WA, at_a);
        place(shape_b, X_WB, at_b);
        least = distance_below(shape_a, at_a, shape_b, at_b, least);
      }
    }
    return least;
  }

  void compare(double said_m, double truth_m, const Shown& a, const Shown& b, const char* what) {
    const double above_m = std::max(said_m, 0.0) - truth_m;
    const bool meshes = a.is_mesh && b.is_mesh;
    if (above_m > kFclRounding_m) {
      ++report.too_far;
      report.worst_m = std::max(report.worst_m, above_m);
      if (report.failures.size() < 5) {
        std::ostringstream text;
        text << "pair " << report.pairs << ": " << what << " " << said_m << ", truth " << truth_m;
        report.failures.push_back(text.str());
      }
    } else if (truth_m > 0.0 && truth_m < kSurfaceWithin_m) {
      double& shortfall = meshes ? report.shortfall_m : report.round_shortfall_m;
      shortfall = std::max(shortfall, -above_m);
      if (meshes && said_m <= 0.0 && truth_m > 1e-6) ++report.false_contacts;
    }
  }

  static constexpr std::size_t kSolids = 60;
  std::mt19937_64 random_;
  std::vector<Shown> large_, middle_, small_;
};

}  // namespace

double triangles_by_fcl(const TrianglePoints& a, const TrianglePoints& b) {
  MeshData one;
  MeshData other;
  one.vertices.assign(a.begin(), a.end());
  other.vertices.assign(b.begin(), b.end());
  one.triangles = other.triangles = {{0, 1, 2}};
  fcl::DistanceRequestd request;
  fcl::DistanceResultd result;
  const Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  return std::max(0.0, fcl::distance<double>(model_of(one).get(), X, model_of(other).get(), X,
                                             request, result));
}

SurfaceReport check_surfaces(std::size_t pairs, std::uint64_t seed) {
  Checker checker(seed);
  while (checker.report.pairs < pairs) checker.check();
  return checker.report;
}

}  // namespace armloom::soundness
