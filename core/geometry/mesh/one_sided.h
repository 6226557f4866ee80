#pragma once

#include <optional>
#include <vector>

#include "core/geometry/mesh/surface_tree.h"

namespace armloom {

// Removes the second side of solids that are modeled from both sides: CAD programs and Blender
// write each face twice, once reversed. The winding number of such a surface is zero, so it would
// enclose nothing.
//
// A face is doubled if it occurs equally often in both orientations. Among the doubled faces, those
// with an edge that belongs to no other doubled face are removed until none is left. The remaining
// doubled faces enclose something, and a single side of them is kept. So sheets, bins and the wall
// between two boxes keep both sides. Returns nullopt if other faces share an edge with the
// remaining faces, because the solid is then ambiguous.
[[nodiscard]] std::optional<std::vector<Triangle>> one_sided(std::vector<Triangle> triangles);

}  // namespace armloom
