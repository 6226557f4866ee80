#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/geometry/convex/convex_shape.h"

namespace armloom::bench {

// A triangle mesh in the frame P of a link.
struct LinkMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

// A closed convex mesh of about `triangles` triangles that contains the bodies of one link, as the
// collision meshes of robots' makers do: the polytope of the planes that touch the bodies in
// (triangles + 8) / 4 evenly spread directions. It touches them there and stands off at its corners
// (a sphere of 6 cm in 252 triangles: 3 mm), so it never hides a contact. Checked: throws
// std::logic_error if a body leaves it. Precondition: bodies not empty, triangles >= 32.
[[nodiscard]] LinkMesh circumscribed_mesh(const std::vector<ConvexShape>& bodies,
                                          std::size_t triangles);

}  // namespace armloom::bench
