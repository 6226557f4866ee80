#pragma once

#include <map>
#include <string>
#include <vector>

#include "server/codec/format.h"

namespace armloom {

// Additional comments, by the JSON pointer of the member that they describe. "" is the head of the
// document.
using JsonNotes = std::map<std::string, std::vector<std::string>>;

// Returns the value as readable JSON with comments. The comment of a member is its description in
// the schema, at the first occurrence only, followed by its notes. The text reads back as the same
// value (JsonComments::allowed).
[[nodiscard]] std::string commented_json(const Schema& value, const Schema& schema,
                                         const JsonNotes& notes);

}  // namespace armloom
