#include "server/codec/member_part.h"

#include "server/codec/object_format.h"
#include "server/codec/told_part.h"

namespace armloom::formats {
namespace {

// A default that is worth a word: an object's are those of its members.
bool is_telling(const Schema& fallback) {
  return !fallback.is_object() && !(fallback.is_array() && fallback.empty());
}

}  // namespace

Schema object_schema() {
  Schema object{{"type", "object"}, {"additionalProperties", false}};
  object["properties"] = Schema::object();
  return object;
}

Schema constant_schema(const Schema& value) { return {{"const", value}}; }

void describe_times(Schema& object, const std::string& cell_key, const std::string& wall_key,
                    const std::string& text, bool may_lack, Way way) {
  const auto type = [may_lack](const char* name) -> Schema {
    return may_lack ? Schema{name, "null"} : Schema(name);
  };
  describe_member(object, {cell_key, text + ", in cell time", Need::required, {}},
                  {{"type", type("number")}}, std::nullopt, way);
  describe_member(object, {wall_key, "The same in wall time", Need::required, {}},
                  {{"type", type("string")}, {"format", "date-time"}}, std::nullopt, way);
}

void describe_member(Schema& object, const MemberText& member, Schema schema,
                     const std::optional<Schema>& fallback, Way way) {
  if (!member.text.empty()) schema["description"] = member.text;
  const bool always_told = way == Way::out && fallback;
  if (member.need == Need::required || always_told) {
    object["required"].push_back(member.key);
  } else if (way == Way::out) {
    // It is said, or it is not there.
  } else if (member.stated) {
    schema["default"] = *member.stated;
  } else if (fallback && is_telling(*fallback)) {
    schema["default"] = *fallback;
  }
  object["properties"][member.key] = std::move(schema);
}

}  // namespace armloom::formats
