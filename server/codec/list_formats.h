#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "server/codec/format.h"
#include "server/codec/member_access.h"

namespace armloom::formats {

// The allowed size of a list. A list with more than `most` elements is not read and is the fault
// "too-many-<what>". The message calls the elements `noun`.
struct ListSize {
  std::size_t fewest = 0;
  std::optional<std::size_t> most = {};
  std::string noun = "elements";
  std::string what = noun;
};
[[nodiscard]] bool is_readable(const JsonNode& array, const ListSize& size);
void check_fewest(const JsonNode& array, const ListSize& size);

// Operations on a std::vector<T> whose type is erased, for list formats.
struct ListOperations {
  void (*clear)(void* list, std::size_t to_come);
  void* (*add)(void* list);
  const void* (*data)(const void* list);
  std::size_t (*size)(const void* list);
  std::size_t element_size;
};
template <class T>
inline constexpr ListOperations kListOperations{
    [](void* list, std::size_t to_come) {
      static_cast<std::vector<T>*>(list)->clear();
      static_cast<std::vector<T>*>(list)->reserve(to_come);
    },
    [](void* list) -> void* { return &static_cast<std::vector<T>*>(list)->emplace_back(); },
    [](const void* list) -> const void* {
      return static_cast<const std::vector<T>*>(list)->data();
    },
    [](const void* list) { return static_cast<const std::vector<T>*>(list)->size(); }, sizeof(T)};

[[nodiscard]] AnyFormatPtr list(const AnyFormatPtr& element, ListSize size,
                                const ListOperations& operations);
template <class T>
[[nodiscard]] FormatPtr<std::vector<T>> list(const FormatPtr<T>& element, ListSize size = {}) {
  return FormatPtr<std::vector<T>>(list(element->any(), std::move(size), kListOperations<T>));
}

// Operations on a std::map<std::string, T> whose type is erased, for dictionary formats.
struct DictionaryOperations {
  void* (*at)(void* map, const std::string& key);
  void (*write)(JsonWriter& out, const void* map, const AnyFormat& member);
};
template <class T>
inline constexpr DictionaryOperations kDictionaryOperations{
    [](void* map, const std::string& key) -> void* {
      return &(*static_cast<std::map<std::string, T>*>(map))[key];
    },
    [](JsonWriter& out, const void* map, const AnyFormat& format) {
      for (const auto& [key, member] : *static_cast<const std::map<std::string, T>*>(map)) {
        out.key(key);
        format.write_any(out, &member);
      }
    }};

// Describes an object with user-defined keys: {"torso_lift_joint": 0.1}.
[[nodiscard]] AnyFormatPtr dictionary(const AnyFormatPtr& member,
                                      const DictionaryOperations& operations);
template <class T>
[[nodiscard]] FormatPtr<std::map<std::string, T>> dictionary(const FormatPtr<T>& member) {
  return FormatPtr<std::map<std::string, T>>(dictionary(member->any(), kDictionaryOperations<T>));
}

// Describes an array of two: ["table", "panda_link0"].
[[nodiscard]] AnyFormatPtr pair_of(const AnyFormatPtr& element, std::ptrdiff_t first,
                                   std::ptrdiff_t second);
template <class T>
[[nodiscard]] FormatPtr<std::pair<T, T>> pair_of(const FormatPtr<T>& element) {
  using Pair = std::pair<T, T>;
  return FormatPtr<Pair>(
      pair_of(element->any(), offset_of(&Pair::first), offset_of(&Pair::second)));
}

}  // namespace armloom::formats
