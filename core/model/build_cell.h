#pragma once

#include "core/base/problem.h"
#include "core/model/cell.h"
#include "core/model/cell_description.h"

namespace armloom {

// Reads the URDF and SRDF files that the description names and builds the cell.
// Checks everything it can and returns every problem found, not only the first. Place is
// "panda.urdf: joint panda_joint3" or a JSON pointer into the cell file
// ("/robots/0/arms/0/home/3"). Does not look at collisions: that homes are free is checked by
// core/collision.
[[nodiscard]] Result<CellPtr> build_cell(const CellDescription& description);

// What is allowed but rarely meant: meshes that are flat (mesh.h), each file once.
[[nodiscard]] Problems doubts_about_meshes(const Cell& cell);

}  // namespace armloom
