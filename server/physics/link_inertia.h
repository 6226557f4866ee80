#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/geometry/shape.h"

namespace armloom {

// Mass properties of a link in its own frame L. C: center of mass.
struct LinkInertia {
  double mass_kg = 0.0;
  Eigen::Vector3d p_LC = Eigen::Vector3d::Zero();       // m
  Eigen::Matrix3d I_C_kg_m2 = Eigen::Matrix3d::Zero();  // about C, axes of L

  // Returns true if a rigid body, or a limit case such as a thin rod, can have this inertia:
  // positive mass, and principal moments that are not negative, not all zero, and of which none
  // exceeds the sum of the other two (by more than rounding).
  [[nodiscard]] bool is_possible() const;
};

// Computes the inertia of a uniform solid, the union of the shapes, on a grid of about kGridCells
// cells in their bounding box. Overlapping volume counts once. The mass is zero if there are no
// shapes. Precondition: meshes have data.
inline constexpr double kGridCells = 15'000;
[[nodiscard]] LinkInertia inertia_of_shapes(const std::vector<PlacedShape>& shapes,
                                            double density_kg_m3);

}  // namespace armloom
