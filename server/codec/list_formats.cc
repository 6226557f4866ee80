#include "server/codec/list_formats.h"

#include <utility>

namespace armloom::formats {

bool is_readable(const JsonNode& array, const ListSize& size) {
  const std::size_t found = array.raw().size();
  if (!size.most || found <= *size.most) return true;
  array.fault(ProblemKind::too_large, "too-many-" + size.what,
              std::to_string(found) + " " + size.noun + ", at most " + std::to_string(*size.most) +
                  " are read");
  return false;
}

void check_fewest(const JsonNode& array, const ListSize& size) {
  if (array.raw().size() >= size.fewest) return;
  array.invalid("too-few", "at least " + (size.fewest == 1 ? "one" : std::to_string(size.fewest)) +
                               " is expected here, found " + std::to_string(array.raw().size()));
}

Schema list_schema(Schema element, const ListSize& size) {
  Schema schema{{"type", "array"}, {"items", std::move(element)}};
  if (size.fewest > 0) schema["minItems"] = size.fewest;
  if (size.most) schema["maxItems"] = *size.most;
  return schema;
}

Schema dictionary_schema(Schema member) {
  return {{"type", "object"}, {"additionalProperties", std::move(member)}};
}

Schema pair_schema(Schema element) {
  return {{"type", "array"}, {"items", std::move(element)}, {"minItems", 2}, {"maxItems", 2}};
}

}  // namespace armloom::formats
