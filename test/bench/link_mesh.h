#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/geometry/convex/convex_shape.h"

namespace armloom::bench {

struct LinkMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

// Returns a closed convex mesh of about `triangles` triangles around one link's bodies, like
// manufacturers' meshes. Its faces lie in the planes that touch the bodies in (triangles + 8) / 4
// evenly spread directions. The mesh is larger than the bodies at its corners (a 6 cm sphere in 252
// triangles: 3 mm), so it never hides a contact. Throws std::logic_error if a body is not
// contained. Precondition: bodies not empty, triangles >= 32.
[[nodiscard]] LinkMesh circumscribed_mesh(const std::vector<ConvexShape>& bodies,
                                          std::size_t triangles);

}  // namespace armloom::bench
