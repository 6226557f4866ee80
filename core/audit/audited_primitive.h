#pragma once

#include <fcl/geometry/collision_geometry.h>

#include <Eigen/Geometry>
#include <memory>
#include <optional>

#include "core/geometry/shape.h"

namespace armloom {

// A solid box, cylinder or sphere, centered in its own frame. Immutable.
class AuditedPrimitive {
 public:
  explicit AuditedPrimitive(const Shape& shape);  // precondition: no mesh

  // Returns its triangles: a box exactly, a cylinder as a prism at most kPrismExcess_m outside, a
  // sphere as a tiny triangle at its center (subtract round_m() from distances).
  [[nodiscard]] std::shared_ptr<fcl::CollisionGeometryd> make_surface() const;
  [[nodiscard]] double round_m() const;
  static constexpr double kPrismExcess_m = 2e-5;

  [[nodiscard]] double radius_m() const;  // bounding sphere
  [[nodiscard]] bool contains(const Eigen::Vector3d& p, double within_m = 0.0) const;

  // Returns the GJK distance if it is proven to kProof_m: from above by two points of the shapes,
  // and from below by two planes that separate the shapes. Otherwise returns nullopt, for example
  // in contact. For 5 % of upright box pairs, libccd's GJK ends too early and returns up to twice
  // the distance, or none.
  [[nodiscard]] static std::optional<double> proven_distance(const AuditedPrimitive& a,
                                                             const Eigen::Isometry3d& X_WA,
                                                             const AuditedPrimitive& b,
                                                             const Eigen::Isometry3d& X_WB);
  static constexpr double kProof_m = 1e-5;

 private:
  // Returns the largest n·x over the shape; n of unit length in its frame.
  [[nodiscard]] double support(const Eigen::Vector3d& n) const;

  Shape shape_;
  std::shared_ptr<const fcl::CollisionGeometryd> solid_;
};

}  // namespace armloom
