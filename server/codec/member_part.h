#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "server/codec/member_access.h"
#include "server/codec/part.h"

namespace armloom::formats {

enum class Need { required, optional };

struct MemberText {
  std::string key;
  std::string text;  // one or two sentences
  Need need = Need::optional;
  std::optional<Schema> stated = {};  // default, if not that of a new object
  std::string give = {};              // if required: what to give, for the error that it is missing
};

// Adds the member to the schema of an object. `fallback`: value of an absent member, if any.
void describe_member(Schema& object, const MemberText& member, Schema schema,
                     const std::optional<Schema>& fallback, Way way);

[[nodiscard]] AnyPartPtr member_part(MemberText text, const AnyFormatPtr& format,
                                     const Access& access);
[[nodiscard]] AnyPartPtr member_part(Need need, std::string_view key, std::string_view text,
                                     const AnyFormatPtr& format, const Access& access);
[[nodiscard]] AnyPartPtr member_part(Need need, std::string_view key, std::string_view text,
                                     const AnyFormatPtr& format, std::ptrdiff_t offset);

// Returns the access to a member. Empty lists, dictionaries and texts are not written, because an
// absent member means the same.
template <class M, class T>
[[nodiscard]] auto field_access(M T::*where) {
  if constexpr (requires(const M& value) { value.empty(); }) {
    return unless_empty(where);
  } else {
    return offset_of(where);
  }
}
template <class M, class T>
[[nodiscard]] Access field_access(std::optional<M> T::*where) {
  return member_access(where);
}
template <class T, class Where, class M>
[[nodiscard]] PartPtr<T> member(MemberText text, Where T::*where, const FormatPtr<M>& format) {
  return PartPtr<T>(member_part(std::move(text), format->any(), Access(field_access<M>(where))));
}
// Describes a member by two functions. Get(const T&) returns the value or an optional; Put(T&, M)
// stores the value that was read.
template <class T, class M, class Get, class Put>
[[nodiscard]] PartPtr<T> member(MemberText text, const FormatPtr<M>& format, Get get, Put put) {
  return PartPtr<T>(member_part(std::move(text), format->any(), computed_access<T, M>(get, put)));
}

// The common forms, with the arguments key, member, format and description.
template <class T, class Where, class M>
[[nodiscard]] PartPtr<T> required(std::string_view key, Where T::*where, const FormatPtr<M>& format,
                                  std::string_view text) {
  return PartPtr<T>(member_part(Need::required, key, text, format->any(), field_access<M>(where)));
}
template <class T, class Where, class M>
[[nodiscard]] PartPtr<T> field(std::string_view key, Where T::*where, const FormatPtr<M>& format,
                               std::string_view text) {
  return PartPtr<T>(member_part(Need::optional, key, text, format->any(), field_access<M>(where)));
}
template <class T, class Where, class M>
[[nodiscard]] PartPtr<T> field(std::string_view key, Where T::*where, const FormatPtr<M>& format,
                               std::string_view text, Schema stated) {
  return member({std::string(key), std::string(text), Need::optional, std::move(stated)}, where,
                format);
}

// Describes a member that is always written, even if it is empty.
template <class T, class M>
[[nodiscard]] PartPtr<T> always(std::string_view key, M T::*where,
                                const std::type_identity_t<FormatPtr<M>>& format,
                                std::string_view text = "") {
  return PartPtr<T>(member_part(Need::required, key, text, format->any(), offset_of(where)));
}
// Does the same for a member that is written in another form. `spell` converts the member to this
// form, `mean` converts it back.
template <class T, class Where, class M, class Spell, class Mean>
[[nodiscard]] PartPtr<T> always(std::string_view key, Where T::*where, const FormatPtr<M>& format,
                                std::string_view text, Spell spell, Mean mean) {
  return member<T>(
      {std::string(key), std::string(text), Need::required, {}}, format,
      [where, spell](const T& from) { return std::optional<M>(spell(from.*where)); },
      [where, mean](T& to, M value) { to.*where = mean(std::move(value)); });
}

// Describes a member that is written only if it differs from its default, `usual`.
template <class T, class M>
[[nodiscard]] PartPtr<T> omit_default(std::string_view key, M T::*where,
                                      std::type_identity_t<M> usual, const FormatPtr<M>& format,
                                      std::string_view text) {
  return member<T>(
      {std::string(key), std::string(text), Need::optional, as_json(*format->any(), &usual)},
      format,
      [where, usual](const T& from) {
        return from.*where == usual ? std::nullopt : std::optional<M>(from.*where);
      },
      [where](T& to, M value) { to.*where = std::move(value); });
}

template <class T, class M>
[[nodiscard]] PartPtr<T> ignored(std::string_view key, const FormatPtr<M>& format,
                                 std::string_view text) {
  return member<T>(
      {std::string(key), std::string(text), Need::optional, {}}, format,
      [](const T&) { return std::optional<M>(); }, [](T&, const M&) {});
}

// Makes a part that is read and never written.
[[nodiscard]] AnyPartPtr read_only(const AnyPartPtr& part);
template <class T>
[[nodiscard]] PartPtr<T> read_only(const PartPtr<T>& part) {
  return PartPtr<T>(read_only(part.any()));
}

}  // namespace armloom::formats
