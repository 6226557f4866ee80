#pragma once

#include "core/base/diagnostics.h"
#include "core/model/cell.h"

namespace armloom {

// Warns of settings that are allowed but hardly meant, each with its consequence: clearances that
// another one lowers or that are 0, deviations that no arm keeps or that leave nothing free,
// monitoring and tolerances that catch little, limits beyond what arms do, what stands far away.
void warn_of_settings(const CellDescription& description, const Cell& cell,
                      Diagnostics& diagnostics);

}  // namespace armloom
