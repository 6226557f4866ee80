#pragma once

#include "core/geometry/convex/convex_shape.h"

namespace armloom {

// Largest distance of a cylinder's surrounding prism from the cylinder.
inline constexpr double kPrismOverestimate_m = 1e-4;
inline constexpr int kPrismCornersMost = 256;

// Returns the body as a surface (hull: its faces; cylinder: a prism around it). Prisms of large
// cylinders have kPrismCornersMost corners (for 1.3 m radius 0.1 mm outside).
[[nodiscard]] SolidPtr solid_of(const ConvexShape& body);

}  // namespace armloom
