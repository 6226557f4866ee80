#pragma once

#include "core/base/diagnostics.h"
#include "core/model/cell.h"

namespace armloom {

// Warns of what is allowed but hardly meant, each with its consequence: brakes weaker than what
// they have to brake, arms that lag more, or are measured less exactly, than motions are certified
// for, meshes without an inside or as large as if millimetres were read as metres. The cell was
// built from the description, as far as it could be.
void warn_of_cell(const CellDescription& description, const Cell& cell, Diagnostics& diagnostics);

}  // namespace armloom
