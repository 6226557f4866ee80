#pragma once

#include <optional>
#include <vector>

#include "core/geometry/mesh/surface_tree.h"

namespace armloom {

// The triangles without the other side of solids that are there from both sides: CAD programs and
// Blender write each face twice, once turned around. Such a surface winds about no point, so that
// nothing were inside of it. Of faces that are there as often one way as the other one is kept, if
// they enclose something by themselves: when all that hang on a free edge are taken off, again and
// again, these are left. So sheets, bins and the wall between two boxes, which have two sides by
// right, stay as they are. Nothing, where other faces hang on what is left: then nobody can say.
[[nodiscard]] std::optional<std::vector<Triangle>> one_sided(std::vector<Triangle> triangles);

}  // namespace armloom
