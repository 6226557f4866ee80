#pragma once

#include <map>
#include <string>
#include <vector>

#include "server/codec/format.h"

namespace armloom {

// Additional comments: JSON pointer -> sentences; "" is the head of the document.
using JsonNotes = std::map<std::string, std::vector<std::string>>;

// Returns the value as readable JSON: indented by two spaces, short values on one line, and above
// the first occurrence of each member its description from the schema, followed by its notes. The
// text reads back as the same value (JsonComments::allowed).
[[nodiscard]] std::string commented_json(const Schema& value, const Schema& schema,
                                         const JsonNotes& notes);

}  // namespace armloom
