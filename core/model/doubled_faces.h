#pragma once

#include <vector>

#include "core/model/surface_tree.h"

namespace armloom {

// CAD programs write solids of which each face stands there twice, once for either side: its
// surface has no inside then, by any count. Where all triangles of a component (which hangs
// together by common corners) come in pairs of the same corners, and one of each pair closes
// (is_closed), only that one is kept. Sheets, which do not close, stay as they are.
[[nodiscard]] std::vector<Triangle> without_doubled_faces(std::vector<Triangle> triangles,
                                                          std::size_t vertices);

}  // namespace armloom
