#pragma once

#include <Eigen/Core>

#include "core/geometry/mesh/surface_tree.h"

namespace armloom {

// Whether the surface may enclose a point that does not lie on it. What is enclosed: every point
// about which one of its components winds (a winding number other than zero: surfaces that overlap
// or lie in each other are one solid, and a room between several boxes is none). Where a
// component's triangles are not of one mind about outside: every point that no ray leaves without
// crossing that component.
//
// A yes may be wrong, a no never: twelve rays are cast until one passes all triangles clearly, none
// of them at an edge or along a face, and says which; when there is none, that is a yes.
[[nodiscard]] bool may_enclose(const SurfaceTree& tree, const Eigen::Vector3d& p_T);

}  // namespace armloom
