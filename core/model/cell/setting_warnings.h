#pragma once

#include "core/base/diagnostics.h"
#include "core/model/cell.h"

namespace armloom {

// Warns of settings that are probably mistakes, each with its consequence: clearances of 0 or
// without effect, tracking errors that no arm keeps or that leave nothing free, slow monitoring,
// large tolerances, implausible limits, and robots or objects far away.
void warn_of_settings(const CellDescription& description, const Cell& cell,
                      Diagnostics& diagnostics);

}  // namespace armloom
