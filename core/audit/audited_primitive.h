#pragma once

#include <fcl/geometry/collision_geometry.h>

#include <Eigen/Geometry>
#include <memory>
#include <optional>

#include "core/geometry/shape.h"

namespace armloom {

// The audit's model of a box, cylinder or sphere: solid, about its center. Immutable.
class AuditedPrimitive {
 public:
  explicit AuditedPrimitive(const Shape& shape);  // precondition: no mesh

  // Returns its triangles. A box is exact. A cylinder is a prism around it, at most kPrismExcess_m
  // outside. A sphere is a tiny triangle at its center; round_m() is subtracted from its distances.
  [[nodiscard]] std::shared_ptr<fcl::CollisionGeometryd> make_surface() const;
  [[nodiscard]] double round_m() const;
  static constexpr double kPrismExcess_m = 2e-5;

  [[nodiscard]] double radius_m() const;  // bounding sphere
  [[nodiscard]] bool contains(const Eigen::Vector3d& p, double within_m = 0.0) const;

  // Returns the GJK distance if proven to kProof_m: not above the distance of two points of the
  // shapes, and not below the gap between two planes that separate them. Returns nullopt if not
  // proven, as in contact: for 5 % of upright box pairs, libccd's GJK ends too early and returns up
  // to twice the distance, or none.
  [[nodiscard]] static std::optional<double> proven_distance(const AuditedPrimitive& a,
                                                             const Eigen::Isometry3d& X_WA,
                                                             const AuditedPrimitive& b,
                                                             const Eigen::Isometry3d& X_WB);
  static constexpr double kProof_m = 1e-5;

 private:
  // Returns the largest n·x over the shape; n of unit length in the shape's frame.
  [[nodiscard]] double support(const Eigen::Vector3d& n) const;

  Shape shape_;
  std::shared_ptr<const fcl::CollisionGeometryd> solid_;
};

}  // namespace armloom
