#include "server/codec/member_part.h"

namespace armloom::formats {
namespace {

// A default that is worth a word: an object's are those of its members.
bool is_telling(const Schema& fallback) {
  return !fallback.is_object() && !(fallback.is_array() && fallback.empty());
}

}  // namespace

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
