#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/geometry/surface/triangle_distance.h"

namespace armloom::soundness {

// The distances of concave meshes against FCL's of the same triangles, and solid angles.
struct SurfaceReport {
  std::size_t pairs = 0;
  std::size_t apart = 0;  // truly
  std::size_t in_contact = 0;
  std::size_t inside = 0;             // of these, surfaces that do not touch: one holds the other
  std::size_t opened = 0;             // apart, though convex pieces are closer than 1 mm
  std::size_t too_far = 0;            // said to be farther apart than they are: must be none
  double worst_m = 0.0;               // by how much at most
  double shortfall_m = 0.0;           // the most that a distance is too small, of meshes
  double round_shortfall_m = 0.0;     // of meshes to round shapes, whose truth is inscribed
  std::size_t false_contacts = 0;     // said to touch, but apart by more than 1 um
  std::vector<std::string> failures;  // the first few
};

// `pairs` random pairs near each other, or one in the other: concave meshes, noisy ones, such with
// loose components or triangles turned over; every fourth against a box, cylinder, capsule or
// sphere, whose truth is that of a mesh inscribed in it.
[[nodiscard]] SurfaceReport check_surfaces(std::size_t pairs, std::uint64_t seed);

// The distance of two triangles.
[[nodiscard]] double triangles_by_fcl(const TrianglePoints& a, const TrianglePoints& b);

}  // namespace armloom::soundness
