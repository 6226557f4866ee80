#pragma once

#include <string>

#include "server/codec/format.h"

namespace armloom {

// Replaces each named part (formats::named) by {"$ref": place + name} and adds its schema to
// `parts`. Throws std::logic_error if a name has two schemas.
[[nodiscard]] Schema refer_to_names(const Schema& schema, const std::string& place, Schema& parts);

}  // namespace armloom
