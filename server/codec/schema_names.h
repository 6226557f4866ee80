#pragma once

#include <string>

#include "server/codec/format.h"

namespace armloom {

// Returns the schema with each named part (formats::named) replaced by {"$ref": place + name}. Adds
// the schemas of the named parts to `parts`. Throws std::logic_error if a name has two schemas.
[[nodiscard]] Schema refer_to_names(const Schema& schema, const std::string& place, Schema& parts);

}  // namespace armloom
