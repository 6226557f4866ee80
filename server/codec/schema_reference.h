#pragma once

#include <string>

#include "server/codec/format.h"

namespace armloom {

// Returns a JSON schema as Markdown: a section with a table of members for each object, outermost
// first. Takes units from the keys. Supports only schemas made by formats: no references, no
// patterns.
[[nodiscard]] std::string schema_reference(const Schema& schema);

// Returns "rad/s" for "velocity_rad_s"; an empty string if the key has no unit.
[[nodiscard]] std::string unit_of_key(const std::string& key);

}  // namespace armloom
