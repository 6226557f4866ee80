#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/codec/member_part.h"

namespace armloom::formats {

// Rules over several members of an object.

enum class HowMany { exactly_one, at_most_one };
[[nodiscard]] AnyPartPtr count_rule(HowMany how_many, std::vector<std::string> keys);
template <class T>
[[nodiscard]] PartPtr<T> exactly_one(std::vector<std::string> keys) {
  return PartPtr<T>(count_rule(HowMany::exactly_one, std::move(keys)));
}
template <class T>
[[nodiscard]] PartPtr<T> at_most_one(std::vector<std::string> keys) {
  return PartPtr<T>(count_rule(HowMany::at_most_one, std::move(keys)));
}

// Makes a part whose members require the member `companion`. They are not written without it.
[[nodiscard]] AnyPartPtr only_with(std::string_view companion, const Access& access,
                                   const AnyPartPtr& part);
template <class T, class M>
[[nodiscard]] PartPtr<T> only_with(std::string_view companion, std::optional<M> T::*where,
                                   const PartPtr<T>& part) {
  return PartPtr<T>(only_with(companion, member_access(where), part.any()));
}

// Makes a part that applies only to objects without the member `key`. `may_be`: false if objects
// with `key` are always refused.
[[nodiscard]] AnyPartPtr unless(std::string_view key, const AnyPartPtr& part, bool may_be);
template <class T>
[[nodiscard]] PartPtr<T> unless(std::string_view key, const PartPtr<T>& part) {
  return PartPtr<T>(unless(key, part.any(), true));
}
// Does the same as unless() for a `key` that not_served() refuses. The members of the part are then
// not reported as missing, so that there is only one fault.
template <class T>
[[nodiscard]] PartPtr<T> unless_refused(std::string_view key, const PartPtr<T>& part) {
  return PartPtr<T>(unless(key, part.any(), false));
}

// A member that is known but not supported. If `but_for` is given, this value is accepted. Any
// other value is the fault `slug` with the message `sentence`.
struct NotServed {
  std::string key;
  std::string slug;
  std::string sentence;
  std::optional<nlohmann::json> but_for = {};
  std::string text = "";  // for the schema; unused if no value is supported
};
[[nodiscard]] AnyPartPtr not_served_part(NotServed rule);
template <class T>
[[nodiscard]] PartPtr<T> not_served(NotServed rule) {
  return PartPtr<T>(not_served_part(std::move(rule)));
}

}  // namespace armloom::formats
