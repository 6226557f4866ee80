#pragma once

#include "core/base/diagnostics.h"
#include "core/model/cell.h"

namespace armloom {

// Warns of settings that are probably mistakes, and states the consequence of each:
// - clearances of 0 or without effect,
// - tracking errors that no arm can keep, or with which almost no motion is free,
// - slow monitoring, large tolerances, implausible limits,
// - robots or objects that are far away.
void warn_of_settings(const CellDescription& description, const Cell& cell,
                      Diagnostics& diagnostics);

}  // namespace armloom
