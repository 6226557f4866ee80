#pragma once

#include "core/geometry/convex/convex_shape.h"

namespace armloom {

// How far a cylinder's prism may be outside the cylinder.
inline constexpr double kPrismOverestimate_m = 1e-4;
inline constexpr int kPrismCornersMost = 256;

// Returns the body as a surface (hull: its faces; cylinder: a prism around it, with
// kPrismCornersMost corners if large: 0.1 mm outside for 1.3 m radius).
[[nodiscard]] SolidPtr solid_of(const ConvexShape& body);

}  // namespace armloom
