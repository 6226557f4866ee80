#pragma once

#include <string>

#include "core/model/cell_description.h"
#include "server/codec/format.h"
#include "server/codec/object_format.h"

namespace armloom {

// Describes every field of the cell file. The following are made from it: the reader, the schema,
// config/README.md, the output of `armloom import`, and the settings in GET /cell.
[[nodiscard]] const Format<CellDescription>& cell_format();

// Returns clearances, checking, scheduling, monitor and execution as members of one object.
[[nodiscard]] formats::PartPtr<CellDescription> settings_part();
// Returns "monitor: rate_hz 100, ...", one line per group.
[[nodiscard]] std::string settings_text(const CellDescription& settings);

}  // namespace armloom
