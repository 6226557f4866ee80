#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/geometry/surface/triangle_distance.h"

namespace armloom::soundness {

// Compares distances of concave meshes with FCL's for the same triangles, and with solid angles.
struct SurfaceReport {
  std::size_t pairs = 0;
  std::size_t apart = 0;  // true separations
  std::size_t in_contact = 0;
  std::size_t inside = 0;             // of these, one contains the other
  std::size_t opened = 0;             // apart, although convex pieces are closer than 1 mm
  std::size_t too_far = 0;            // computed distances above the true distance: must be 0
  double worst_m = 0.0;               // largest excess
  double shortfall_m = 0.0;           // largest underestimate of a distance between meshes
  double round_shortfall_m = 0.0;     // the same between meshes and round shapes
  std::size_t false_contacts = 0;     // reported as touching, but apart by more than 1 um
  std::vector<std::string> failures;  // the first few
};

// Checks random pairs near each other or one inside the other. The meshes are concave; some are
// noisy, have loose components or flipped triangles. In every fourth pair one body is a primitive,
// whose reference mesh is inscribed.
[[nodiscard]] SurfaceReport check_surfaces(std::size_t pairs, std::uint64_t seed);

[[nodiscard]] double triangles_by_fcl(const TrianglePoints& a, const TrianglePoints& b);

}  // namespace armloom::soundness
