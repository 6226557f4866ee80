#pragma once

#include "core/geometry/convex/convex_shape.h"

namespace armloom {

// Largest distance of a cylinder's surrounding prism from the cylinder.
inline constexpr double kPrismOverestimate_m = 1e-4;
inline constexpr int kPrismCornersMost = 256;

// Returns the body as a surface (hull: its faces). A cylinder becomes a prism around it. Prisms of
// large cylinders have kPrismCornersMost corners (0.1 mm outside for a radius of 1.3 m).
[[nodiscard]] SolidPtr solid_of(const ConvexShape& body);

}  // namespace armloom
