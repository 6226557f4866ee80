#pragma once

#include <string>

#include "server/codec/format.h"

namespace armloom {

// Returns the JSON schema of cell files (draft 2020-12).
[[nodiscard]] const Schema& cell_schema();
// Returns the text of config/cell.schema.json, GET /cell.schema.json and `armloom schema`.
[[nodiscard]] std::string cell_schema_text();
// Returns the text of config/README.md and `armloom schema --markdown`.
[[nodiscard]] std::string cell_reference_text();

}  // namespace armloom
