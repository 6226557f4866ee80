#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>

#include "server/codec/member_part.h"

namespace armloom::formats {

// Members that are written and described, but never read. Get is a data member or a function of T.
[[nodiscard]] AnyPartPtr output_part(Need need, std::string_view key, std::string_view text,
                                     const AnyFormatPtr& format, const Access& access);
[[nodiscard]] AnyPartPtr output_part(Need need, std::string_view key, std::string_view text,
                                     const AnyFormatPtr& format, std::ptrdiff_t offset);

// The type of the objects that a Get reads.
template <class M, class T>
T object_of(M T::*);
template <class R, class T>
T object_of(R (*)(const T&));
template <class R, class F, class T>
T object_of_call(R (F::*)(const T&) const);
template <class F>
requires requires { &F::operator(); }
auto object_of(F) -> decltype(object_of_call(&F::operator()));
template <class Get>
using ObjectOf = decltype(object_of(std::declval<Get>()));

template <class M, class T>
[[nodiscard]] std::ptrdiff_t output_access(M T::*where) {
  return offset_of(where);
}
template <class M, class T>
[[nodiscard]] Access output_access(std::optional<M> T::*where) {
  return member_access(where);
}
// Returns an access by std::invoke(get, const T&). It must return an M, or an optional or a pointer
// that may be empty.
template <class M, class Get>
[[nodiscard]] Access output_access(Get get) {
  using T = ObjectOf<Get>;
  return Access(
      get,
      [](const Access& access, const void* object, const UseValue& use) {
        const auto& member = std::invoke(access.state<Get>(), *static_cast<const T*>(object));
        if constexpr (std::is_convertible_v<decltype(member), const M&>) {
          const M& value = member;
          use(&value);
        } else if (member) {
          const M& value = *member;
          use(&value);
        }
      },
      nullptr);
}

template <class M, class Get>
[[nodiscard]] PartPtr<ObjectOf<Get>> output_only(std::string_view key, Get get,
                                                 const FormatPtr<M>& format,
                                                 std::string_view text = "") {
  return PartPtr<ObjectOf<Get>>(
      output_part(Need::required, key, text, format->any(), output_access<M>(get)));
}
// Describes a member that is absent if Get returns nullopt or a null pointer.
template <class M, class Get>
[[nodiscard]] PartPtr<ObjectOf<Get>> output_if(std::string_view key, Get get,
                                               const FormatPtr<M>& format,
                                               std::string_view text = "") {
  return PartPtr<ObjectOf<Get>>(
      output_part(Need::optional, key, text, format->any(), output_access<M>(get)));
}

// Describes a member with a constant value: "type": "job".
[[nodiscard]] AnyPartPtr constant_part(std::string_view key, const Schema& value);
template <class T, class Value>
[[nodiscard]] PartPtr<T> constant(std::string_view key, Value value) {
  return PartPtr<T>(constant_part(key, value));
}

// For `what` = "started", describes the members "started_s" (cell time) and "started_at" (wall
// time, if known). `may_lack`: the time is a std::optional<TimePoint>; nullopt is written as null.
[[nodiscard]] AnyPartPtr output_times(std::string_view what, std::ptrdiff_t offset, bool may_lack,
                                      std::string_view text);
template <class T>
[[nodiscard]] PartPtr<T> output_times(std::string_view what, TimePoint T::*where,
                                      std::string_view text) {
  return PartPtr<T>(output_times(what, offset_of(where), false, text));
}
template <class T>
[[nodiscard]] PartPtr<T> output_times(std::string_view what, std::optional<TimePoint> T::*where,
                                      std::string_view text) {
  return PartPtr<T>(output_times(what, offset_of(where), true, text));
}

}  // namespace armloom::formats
