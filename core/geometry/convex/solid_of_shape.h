#pragma once

#include "core/geometry/convex/convex_shape.h"

namespace armloom {

// How far the prism that stands for a cylinder is outside of it at most.
inline constexpr double kPrismOverestimate_m = 1e-4;
inline constexpr int kPrismCornersMost = 256;

// The body itself as a surface (a hull: its faces). Of a cylinder a prism around it, for large ones
// of kPrismCornersMost corners (of 1.3 m radius: 0.1 mm outside).
[[nodiscard]] SolidPtr solid_of(const ConvexShape& body);

}  // namespace armloom
