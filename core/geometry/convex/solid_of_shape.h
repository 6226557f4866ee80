#pragma once

#include "core/geometry/convex/convex_shape.h"

namespace armloom {

// Largest distance (m) by which a cylinder's prism may reach outside the cylinder.
inline constexpr double kPrismOverestimate_m = 1e-4;
inline constexpr int kPrismCornersMost = 256;

// Returns the body's surface. A hull has its faces, a cylinder a prism around it. If the radius is
// above 1.3 m, the prism has kPrismCornersMost corners and reaches farther outside than
// kPrismOverestimate_m.
[[nodiscard]] SolidPtr solid_of(const ConvexShape& body);

}  // namespace armloom
