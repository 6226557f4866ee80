#pragma once

#include <string>

#include "server/codec/format.h"

namespace armloom {

// The schema with {"$ref": place + name} in the place of each named part (formats::named), whose
// own schema goes to `parts`, by name. Throws std::logic_error when two different schemas have one
// name.
[[nodiscard]] Schema refer_to_names(const Schema& schema, const std::string& place, Schema& parts);

}  // namespace armloom
