#include "core/collision/diagram/body_sweep.h"

#include <array>
#include <optional>

#include "core/collision/state/shape_groups.h"

namespace armloom {
namespace {

using Eigen::Vector3d;

bool shapes_keep_apart(const MovingShape& a, const MovingShape& b, double limit_m,
                       double enough_m) {
  const double reach_m = enough_m + a.shape.bounding_radius_m() + b.shape.bounding_radius_m();
  if ((a.at.segment.center - b.at.segment.center).squaredNorm() >= reach_m * reach_m) return true;
  if (lower_bound(a.shape, a.at, b.shape, b.at).distance_m >= enough_m) return true;
  const std::optional<Separation> apart = separation(a.shape, a.at, b.shape, b.at, enough_m);
  if (!apart) return false;
  if (apart->distance_m >= enough_m) return true;
  if (apart->distance_m < limit_m) return false;
  return swept_gap(a, b, apart->n_W) >= limit_m;
}

struct MovingGroup {
  const ShapeGroups& group;
  std::span<const MovingAxis> axes;
};

// Returns true if every pair of convex pieces of the two groups is proven to keep limit_m.
bool groups_keep_apart(const std::vector<ConvexShape>& shapes, const MovingGroup& a,
                       const MovingGroup& b, double limit_m, double enough_m) {
  PlacedConvexShape at_a;
  PlacedConvexShape at_b;
  for (std::size_t i = a.group.begin(); i < a.group.end(); ++i) {
    a.group.place(i, at_a);
    for (std::size_t j = b.group.begin(); j < b.group.end(); ++j) {
      b.group.place(j, at_b);
      if (!shapes_keep_apart({shapes[i], at_a, a.axes}, {shapes[j], at_b, b.axes}, limit_m,
                             enough_m)) {
        return false;
      }
    }
  }
  return true;
}

// Most free cells are proven with some hundred pairs of triangles. If more are needed, halving the
// cell decides it faster.
constexpr int kMostAsked = 500;

// The surfaces of two moving bodies, in the frame T of the first body's tree of triangles.
class SweptSurfaces final : public KeptApart {
 public:
  SweptSurfaces(const MovingSolid& a, const MovingSolid& b, double limit_m)
      : limit_m_(limit_m),
        a_(a, a.at.X_WT.inverse(Eigen::Isometry)),
        b_(b, a.at.X_WT.inverse(Eigen::Isometry)) {}

  [[nodiscard]] bool keeps(const TrianglePoints& at_a, const TrianglePoints& at_b,
                           const Vector3d& n_T) override {
    if (++asked_ > kMostAsked) return false;
    return -Sweep(a_.axes, n_T).reach(at_a, a_.radius_m) -
               Sweep(b_.axes, -n_T).reach(at_b, b_.radius_m) >=
           limit_m_;
  }
  [[nodiscard]] double enough_along(const Vector3d& n_T) const override {
    return limit_m_ + Sweep(a_.axes, n_T).overestimate(a_.corners, a_.radius_m) +
           Sweep(b_.axes, -n_T).overestimate(b_.corners, b_.radius_m);
  }

 private:
  struct Side {
    std::vector<MovingAxis> axes;
    std::array<Vector3d, 8> corners;  // of a box around the surface, in T
    double radius_m;

    Side(const MovingSolid& moving, const Eigen::Isometry3d& X_TW)
        : axes(moving.axes.begin(), moving.axes.end()), radius_m(moving.at.solid.radius_m) {
      for (MovingAxis& axis : axes) {
        axis.z_W = X_TW.linear() * axis.z_W;
        axis.p_WO = X_TW * axis.p_WO;
      }
      const SurfaceTree::Box& root = moving.at.solid.tree->root;
      const Eigen::Isometry3d X_TS = X_TW * moving.at.X_WT;
      for (unsigned corner = 0; corner < corners.size(); ++corner) {
        Vector3d p = root.half.cast<double>();
        for (unsigned k = 0; k < 3; ++k) {
          if ((corner >> k & 1U) != 0) p[k] = -p[k];
        }
        corners[corner] = X_TS * (root.center.cast<double>() + p);
      }
    }
  };

  double limit_m_;
  Side a_, b_;
  int asked_ = 0;
};

}  // namespace

double swept_gap(const MovingShape& a, const MovingShape& b, const Vector3d& n_W) {
  return -Sweep(a.axes, n_W).reach(a.shape, a.at) - Sweep(b.axes, -n_W).reach(b.shape, b.at);
}

// If no two triangles can meet during the motion, neither surface gets inside the other.
bool surfaces_keep_apart(const MovingSolid& a, const MovingSolid& b, double limit_m,
                         double enough_m) {
  SweptSurfaces swept(a, b, limit_m);
  return surfaces_apart(a.at, b.at, enough_m, swept);
}

bool keep_apart(const std::vector<ConvexShape>& shapes, const MovingBody& a, const MovingBody& b,
                double limit_m, double enough_m) {
  for (ShapeGroups of_a(shapes, a.at); !of_a.ended(); of_a.next()) {
    for (ShapeGroups of_b(shapes, b.at); !of_b.ended(); of_b.next()) {
      if (groups_keep_apart(shapes, {of_a, a.axes}, {of_b, b.axes}, limit_m, enough_m)) continue;
      if (!of_a.are_pieces() && !of_b.are_pieces()) return false;
      if (!surfaces_keep_apart({of_a.solid(), a.axes}, {of_b.solid(), b.axes}, limit_m, enough_m)) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace armloom
