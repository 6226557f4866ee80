#pragma once

#include <Eigen/Core>

#include "core/geometry/mesh/surface_tree.h"

namespace armloom {

// Returns true if the surface may enclose a point that is not on it. It encloses every point about
// which a component has a nonzero winding number: overlapping or nested surfaces are one solid, and
// a space between several boxes is outside. A component of inconsistent orientation encloses every
// point that no ray leaves without crossing it.
//
// False is certain; true may be wrong. Up to twelve rays are cast until one passes all triangles
// clearly, neither at an edge nor along a face. If none does, the result is true.
[[nodiscard]] bool may_enclose(const SurfaceTree& tree, const Eigen::Vector3d& p_T);

}  // namespace armloom
