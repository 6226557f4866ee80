#pragma once

#include <map>
#include <string>
#include <vector>

#include "server/codec/format.h"

namespace armloom {

// Comments of a document's own: JSON pointer -> sentences; "" is the document's head.
using JsonNotes = std::map<std::string, std::vector<std::string>>;

// A JSON value as a person would write it: two spaces deep, what fits on one line on one line,
// and above each member the description that the schema has of it, the first time that it is met.
// Notes stand below the description. The text reads back as the same value (JsonComments::allowed).
[[nodiscard]] std::string commented_json(const Schema& value, const Schema& schema,
                                         const JsonNotes& notes);

}  // namespace armloom
