#pragma once

#include <Eigen/Core>

#include "core/geometry/mesh/surface_tree.h"

namespace armloom {

// Returns true if the surface may enclose a point that is not on it. The surface encloses every
// point about which a component has a nonzero winding number. So overlapping or nested components
// are one solid, and a space between several boxes is outside. A component of inconsistent
// orientation encloses every point from which each ray tried crosses this component.
//
// False is certain; true may be wrong. Casts up to twelve rays from the point, until a ray decides.
// A ray that passes near an edge or along a face does not decide. If no ray decides, the result is
// true.
[[nodiscard]] bool may_enclose(const SurfaceTree& tree, const Eigen::Vector3d& p_T);

}  // namespace armloom
