#pragma once

#include <string>

#include "server/codec/format.h"

namespace armloom {

[[nodiscard]] const Schema& cell_schema();
// The text of config/cell.schema.json.
[[nodiscard]] std::string cell_schema_text();
// The text of config/README.md.
[[nodiscard]] std::string cell_reference_text();

}  // namespace armloom
