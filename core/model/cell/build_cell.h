#pragma once

#include "core/base/problem.h"
#include "core/model/cell.h"
#include "core/model/cell_description.h"

namespace armloom {

// Reads the URDF, SRDF and joint limits files that the description names, and builds the cell.
// Returns every problem found, not only the first. The place of a problem is a place in a robot
// file ("panda.urdf:12: joint panda_joint3") or a JSON pointer into the cell file
// ("/robots/0/arms/0/home/3"). If a line in the cell file solves the problem, the message quotes
// that line. Overwrites `warnings`, also if there are problems. Each warning names a probable
// mistake or ignored input, and its consequence. Does not check collisions; core/collision checks
// that homes are collision-free.
[[nodiscard]] Result<CellPtr> build_cell(const CellDescription& description, Problems& warnings);
[[nodiscard]] Result<CellPtr> build_cell(const CellDescription& description);

}  // namespace armloom
