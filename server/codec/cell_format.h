#pragma once

#include <string>

#include "core/model/cell_description.h"
#include "server/codec/format.h"
#include "server/codec/object_format.h"

namespace armloom {

// The one description of a cell file: every field with type, range, default and meaning. From it
// come the reader (cell_codec.h), the JSON schema, config/README.md, what `armloom import` writes,
// and the settings in GET /cell. A new field is one line here, and its use.
[[nodiscard]] const Format<CellDescription>& cell_format();

// The part that is written on its own, in GET /cell: clearances, checking, scheduling, monitor,
// execution, as members of one object.
[[nodiscard]] formats::PartPtr<CellDescription> settings_part();
// The same for people, by the file's own names: "monitor: rate_hz 100, ...", a line a group.
[[nodiscard]] std::string settings_text(const CellDescription& settings);

}  // namespace armloom
