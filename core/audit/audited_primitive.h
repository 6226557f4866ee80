#pragma once

#include <fcl/geometry/collision_geometry.h>

#include <Eigen/Geometry>
#include <memory>
#include <optional>

#include "core/geometry/shape.h"

namespace armloom {

// A box, cylinder or sphere as the audit sees it: solid, about its centre. Immutable.
class AuditedPrimitive {
 public:
  explicit AuditedPrimitive(const Shape& shape);  // precondition: no mesh

  // Its triangles: of a box exact, of a cylinder a prism around it that stands off by at most
  // kPrismExcess_m, of a sphere a speck at its centre, from which everything is round_m nearer.
  [[nodiscard]] std::shared_ptr<fcl::CollisionGeometryd> make_surface() const;
  [[nodiscard]] double round_m() const;
  static constexpr double kPrismExcess_m = 2e-5;

  [[nodiscard]] double radius_m() const;  // of its bounding sphere
  [[nodiscard]] bool contains(const Eigen::Vector3d& p, double within_m = 0.0) const;

  // The distance by GJK where it is proven to kProof_m: it is no more than that of two points of
  // the shapes, and no less than the gap between two planes that hold the shapes apart. Nothing
  // where it is not, as in contact: libccd's GJK ends far too early for one pair of upright boxes
  // in twenty, and tells up to twice the distance, or none.
  [[nodiscard]] static std::optional<double> proven_distance(const AuditedPrimitive& a,
                                                             const Eigen::Isometry3d& X_WA,
                                                             const AuditedPrimitive& b,
                                                             const Eigen::Isometry3d& X_WB);
  static constexpr double kProof_m = 1e-5;

 private:
  // The largest n·x over the shape, n of unit length in the shape's frame.
  [[nodiscard]] double support(const Eigen::Vector3d& n) const;

  Shape shape_;
  std::shared_ptr<const fcl::CollisionGeometryd> solid_;
};

}  // namespace armloom
