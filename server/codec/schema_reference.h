#pragma once

#include <string>

#include "server/codec/format.h"

namespace armloom {

// A JSON schema for people, in Markdown: a section with a table of the members for each object,
// from the outermost in. Units stand in the keys (units_of_key). Understands what formats write:
// no references, no patterns.
[[nodiscard]] std::string schema_reference(const Schema& schema);

// "rad/s" for "velocity_rad_s"; empty: the key ends in no unit.
[[nodiscard]] std::string unit_of_key(const std::string& key);

}  // namespace armloom
