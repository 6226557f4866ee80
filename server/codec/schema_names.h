#pragma once

#include <string>

#include "server/codec/format.h"

namespace armloom {

// Returns the schema with {"$ref": place + name} instead of each named part (formats::named), and
// adds the schemas of the named parts to `parts`. Throws std::logic_error if two different schemas
// have the same name.
[[nodiscard]] Schema refer_to_names(const Schema& schema, const std::string& place, Schema& parts);

}  // namespace armloom
