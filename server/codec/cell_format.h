#pragma once

#include <string>

#include "core/model/cell_description.h"
#include "server/codec/format.h"
#include "server/codec/object_format.h"

namespace armloom {

// Describes the cell file: type, range, default and meaning of every field. The reader
// (cell_codec.h), the JSON schema, config/README.md, the output of `armloom import` and the
// settings in GET /cell follow from it. A new field needs one line here, and its use.
[[nodiscard]] const Format<CellDescription>& cell_format();

// Describes the settings as members of one object, for GET /cell: clearances, checking, scheduling,
// monitor, execution.
[[nodiscard]] formats::PartPtr<CellDescription> settings_part();
// Returns the settings as text, one line per group: "monitor: rate_hz 100, ...".
[[nodiscard]] std::string settings_text(const CellDescription& settings);

}  // namespace armloom
