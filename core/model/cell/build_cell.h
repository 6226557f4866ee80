#pragma once

#include "core/base/problem.h"
#include "core/model/cell.h"
#include "core/model/cell_description.h"

namespace armloom {

// Reads the URDF, SRDF and joint limits files that the description names and builds the cell.
// Checks everything it can and returns every problem found, not only the first. Place is
// "panda.urdf: joint panda_joint3" or a JSON pointer into the cell file
// ("/robots/0/arms/0/home/3"); where a line in the cell file would help, the sentence says it. Does
// not look at collisions: that homes are free is checked by core/collision.
// `warnings` becomes what can be taken but is hardly meant, or is left out, each with what follows
// from it; also when there are problems.
[[nodiscard]] Result<CellPtr> build_cell(const CellDescription& description, Problems& warnings);
[[nodiscard]] Result<CellPtr> build_cell(const CellDescription& description);

}  // namespace armloom
