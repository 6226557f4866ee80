#pragma once

#include <string>

#include "server/codec/format.h"

namespace armloom {

// Returns a schema as Markdown, with a section and a table for each object. Precondition: the
// schema was made by a format.
[[nodiscard]] std::string schema_reference(const Schema& schema);

// Returns "rad/s" for "velocity_rad_s"; "" if the key has no unit.
[[nodiscard]] std::string unit_of_key(const std::string& key);

}  // namespace armloom
