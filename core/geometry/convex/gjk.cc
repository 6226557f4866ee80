#include "core/geometry/convex/gjk.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace armloom {
namespace {

using Eigen::Vector3d;

// Shapes with flat faces take 5 to 10 steps; on a curved rim, convergence is only linear.
constexpr int kMostSteps = 48;
// A tetrahedron of less height has no inside.
constexpr double kLeastHeight_m = 1e-11;

// A shape without its radius: only the axis if the shape is round.
struct Core {
  const ConvexShape& shape;
  const PlacedConvexShape& at;
  std::uint32_t corner = 0;

  [[nodiscard]] double radius_m() const {
    return shape.kind == ConvexShapeKind::round ? shape.radius_m : 0.0;
  }
  // Returns the shape's farthest point along n, relative to the shape's center, in world axes. The
  // search on a hull starts at the corner found last.
  [[nodiscard]] Vector3d farthest(const Vector3d& n_W) {
    if (shape.kind == ConvexShapeKind::round) {
      return n_W.dot(at.segment.half) < 0.0 ? Vector3d(-at.segment.half) : at.segment.half;
    }
    const Vector3d n = at.X_WS.linear().transpose() * n_W;
    Vector3d p;
    if (shape.kind == ConvexShapeKind::hull) {
      corner = shape.hull->uphill(n, corner);
      p = shape.hull->hull.vertices[corner];
    } else if (shape.kind == ConvexShapeKind::box) {
      for (int i = 0; i < 3; ++i) p[i] = std::copysign(shape.half_size_m[i], n[i]);
    } else {
      const double across = std::hypot(n.x(), n.y());
      const double scale = across > 0.0 ? shape.radius_m / across : 0.0;
      p = {n.x() * scale, n.y() * scale, std::copysign(shape.half_length_m, n.z())};
    }
    return at.X_WS.linear() * p;
  }
  // Returns how much farther along n the shape reaches than the last result of farthest(). Nonzero
  // only for hulls, where that search may end too early.
  [[nodiscard]] double beyond(const Vector3d& n_W) const {
    if (shape.kind != ConvexShapeKind::hull) return 0.0;
    const Vector3d n = at.X_WS.linear().transpose() * n_W;
    return std::max(0.0, shape.hull->support(n) - n.dot(shape.hull->hull.vertices[corner]));
  }
};

// The simplex of GJK: up to four points of the shapes' Minkowski difference.
class Simplex {
 public:
  void add(const Vector3d& p) { points_[static_cast<std::size_t>(size_++)] = p; }
  [[nodiscard]] bool has(const Vector3d& p) const {
    return std::find(points_.begin(), points_.begin() + size_, p) != points_.begin() + size_;
  }
  // Returns the simplex's point nearest to the origin. Keeps only the corners of the face, edge or
  // corner on which this point lies, or all four if the origin is inside.
  [[nodiscard]] Vector3d reduce() {
    switch (size_) {
      case 1:
        return points_[0];
      case 2:
        return of_segment();
      case 3:
        return keep(of_triangle(0, 1, 2));
      default:
        return of_tetrahedron();
    }
  }
  [[nodiscard]] bool is_full() const { return size_ == 4; }

 private:
  struct Nearest {
    Vector3d p;
    std::array<int, 3> corners;
    int count;
  };

  [[nodiscard]] Nearest between(int i, int j, double share) const {
    return {points_[static_cast<std::size_t>(i)] + share * (points_[static_cast<std::size_t>(j)] -
                                                            points_[static_cast<std::size_t>(i)]),
            {i, j, 0},
            2};
  }
  [[nodiscard]] Nearest corner(int i) const {
    return {points_[static_cast<std::size_t>(i)], {i, 0, 0}, 1};
  }
  Vector3d keep(const Nearest& nearest) {
    const std::array<Vector3d, 4> from = points_;
    for (int i = 0; i < nearest.count; ++i) {
      const auto k = static_cast<std::size_t>(i);
      points_[k] = from[static_cast<std::size_t>(nearest.corners[k])];
    }
    size_ = nearest.count;
    return nearest.p;
  }

  Vector3d of_segment() {
    const Vector3d along = points_[1] - points_[0];
    const double share = -points_[0].dot(along) / along.squaredNorm();
    if (!(share > 0.0)) return keep(corner(0));
    if (share >= 1.0) return keep(corner(1));
    return keep(between(0, 1, share));
  }

  // Returns the triangle's point nearest to the origin (C. Ericson, "Real-Time Collision
  // Detection", 5.1.5).
  [[nodiscard]] Nearest of_triangle(int i, int j, int k) const {
    const Vector3d& a = points_[static_cast<std::size_t>(i)];
    const Vector3d& b = points_[static_cast<std::size_t>(j)];
    const Vector3d& c = points_[static_cast<std::size_t>(k)];
    const Vector3d ab = b - a;
    const Vector3d ac = c - a;
    const double d1 = -ab.dot(a);
    const double d2 = -ac.dot(a);
    if (d1 <= 0.0 && d2 <= 0.0) return corner(i);
    const double d3 = -ab.dot(b);
    const double d4 = -ac.dot(b);
    if (d3 >= 0.0 && d4 <= d3) return corner(j);
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return between(i, j, d1 / (d1 - d3));
    const double d5 = -ab.dot(c);
    const double d6 = -ac.dot(c);
    if (d6 >= 0.0 && d5 <= d6) return corner(k);
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return between(i, k, d2 / (d2 - d6));
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0.0 && d4 >= d3 && d5 >= d6) {
      return between(j, k, (d4 - d3) / ((d4 - d3) + (d5 - d6)));
    }
    // Numerically better than barycentric coordinates.
    const Vector3d n = ab.cross(ac);
    return {n * (n.dot(a) / n.squaredNorm()), {i, j, k}, 3};
  }

  // Returns the tetrahedron's point nearest to the origin. Checks only faces that have the origin
  // on their outer side or in their plane.
  Vector3d of_tetrahedron() {
    constexpr std::array<std::array<int, 4>, 4> kFaces{
        {{0, 1, 2, 3}, {0, 3, 1, 2}, {0, 2, 3, 1}, {1, 3, 2, 0}}};
    Nearest nearest{Vector3d::Zero(), {}, 0};
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [i, j, k, other] : kFaces) {
      const Vector3d& a = points_[static_cast<std::size_t>(i)];
      const Vector3d n = (points_[static_cast<std::size_t>(j)] - a)
                             .cross(points_[static_cast<std::size_t>(k)] - a);
      const double inner = n.dot(points_[static_cast<std::size_t>(other)] - a);
      const double origin = -n.dot(a);
      const bool is_flat = std::abs(inner) <= kLeastHeight_m * n.norm();
      if (!is_flat && inner * origin > 0.0) continue;
      const Nearest of_face = of_triangle(i, j, k);
      if (of_face.p.squaredNorm() >= least) continue;
      least = of_face.p.squaredNorm();
      nearest = of_face;
    }
    return nearest.count == 0 ? Vector3d(Vector3d::Zero()) : keep(nearest);
  }

  std::array<Vector3d, 4> points_;
  int size_ = 0;
};

}  // namespace

std::optional<Separation> gjk(const ConvexShape& a, const PlacedConvexShape& at_a,
                              const ConvexShape& b, const PlacedConvexShape& at_b,
                              double enough_m) {
  Core of_a{a, at_a};
  Core of_b{b, at_b};
  const double radii_m = of_a.radius_m() + of_b.radius_m();
  const Vector3d centers = at_b.segment.center - at_a.segment.center;
  Simplex simplex;
  Vector3d nearest = centers;  // the point of b - a nearest to the origin
  double length = nearest.norm();
  for (int step = 0; step < kMostSteps && length > 0.0; ++step) {
    const Vector3d n = nearest / length;
    const Vector3d p = centers + of_b.farthest(-n) - of_a.farthest(n);
    const double gap_m = n.dot(p) - radii_m;
    const auto settles = [&](double found_m) {
      const bool is_nearest = step > 0 && length - radii_m - found_m < kGjkSettled_m;
      return found_m > 0.0 && (found_m >= enough_m || is_nearest);
    };
    if (settles(gap_m)) {
      const double proven_m = gap_m - of_a.beyond(n) - of_b.beyond(-n);
      if (settles(proven_m)) return Separation{proven_m, n};
    }
    if (simplex.has(p)) return std::nullopt;
    simplex.add(p);
    nearest = simplex.reduce();
    const double before = length;
    length = nearest.norm();
    if (simplex.is_full() || length <= radii_m) return Separation{0.0, n};  // they share a point
    if (step > 0 && !(length < before)) return std::nullopt;  // no progress because of rounding
  }
  return std::nullopt;
}

}  // namespace armloom
