#pragma once

#include <string>

#include "server/codec/format.h"

namespace armloom {

[[nodiscard]] const Schema& cell_schema();
// Returns the text of config/cell.schema.json.
[[nodiscard]] std::string cell_schema_text();
// Returns the text of config/README.md.
[[nodiscard]] std::string cell_reference_text();

}  // namespace armloom
