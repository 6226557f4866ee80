#pragma once

#include <map>
#include <string>
#include <vector>

#include "server/codec/format.h"

namespace armloom {

// JSON pointer -> additional comments; "" is the head of the document.
using JsonNotes = std::map<std::string, std::vector<std::string>>;

// Returns the value as readable JSON with comments: the description of each member at its first
// occurrence, then its notes. Reads back as the same value (JsonComments::allowed).
[[nodiscard]] std::string commented_json(const Schema& value, const Schema& schema,
                                         const JsonNotes& notes);

}  // namespace armloom
