#pragma once

#include <string>

#include "server/codec/format.h"

namespace armloom {

// The JSON schema of cell files (draft 2020-12), made from their description (cell_format.h).
[[nodiscard]] const Schema& cell_schema();
// The text of config/cell.schema.json, of GET /cell.schema.json and of `armloom schema`.
[[nodiscard]] std::string cell_schema_text();
// The text of config/README.md and of `armloom schema --markdown`.
[[nodiscard]] std::string cell_reference_text();

}  // namespace armloom
