#pragma once

#include "core/base/diagnostics.h"
#include "core/model/cell.h"

namespace armloom {

// Warns of probable mistakes, and states the consequence of each. The cell may be incomplete.
// Mistakes are:
// - brakes weaker than the acceleration,
// - arms with more lag or measurement noise than motions are certified for,
// - meshes that are flat or not closed, or whose size suggests a unit error.
void warn_of_cell(const CellDescription& description, const Cell& cell, Diagnostics& diagnostics);

}  // namespace armloom
