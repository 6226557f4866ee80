#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/number_range.h"
#include "core/base/time.h"
#include "server/codec/format.h"

namespace armloom::formats {

[[nodiscard]] FormatPtr<bool> flag();
[[nodiscard]] FormatPtr<int> integer(int lowest, int highest);
[[nodiscard]] FormatPtr<int> integer(const NumberRange& range);  // bounds must be whole
[[nodiscard]] FormatPtr<std::uint64_t> count();                  // zero or more
// Describes a list of any numbers. It is faster than list(number(kAnyNumber)), which matters for
// trajectories with tens of thousands of numbers.
[[nodiscard]] FormatPtr<std::vector<double>> number_list();
// Describe a cell time in seconds.
[[nodiscard]] FormatPtr<TimePoint> cell_time();
[[nodiscard]] FormatPtr<TimePoint> cell_time(double highest_s);
// Describes a text. An empty text is written as null.
[[nodiscard]] FormatPtr<std::string> text_or_null();

// A rule that a text must obey. A text that breaks the rule is the fault `slug` with the message
// `sentence`. `said` describes the rule in the schema.
struct TextRule {
  bool (*holds)(std::string_view);
  std::string slug;
  std::string sentence;
  Schema said;
};
[[nodiscard]] FormatPtr<std::string> text(TextRule rule);

// Describes an ignored value of this JSON type; `type` "" allows any type.
struct Anything {};
[[nodiscard]] FormatPtr<Anything> anything(std::string type);

// Operations on a std::optional<T> whose type is erased, for nullable formats.
struct OptionalOperations {
  const void* (*value)(const void* maybe);  // null if there is no value
  void* (*emplace)(void* maybe);
  void (*reset)(void* maybe);
};
template <class T>
inline constexpr OptionalOperations kOptionalOperations{
    [](const void* maybe) -> const void* {
      const auto& value = *static_cast<const std::optional<T>*>(maybe);
      return value ? &*value : nullptr;
    },
    [](void* maybe) -> void* { return &static_cast<std::optional<T>*>(maybe)->emplace(); },
    [](void* maybe) { static_cast<std::optional<T>*>(maybe)->reset(); }};

[[nodiscard]] AnyFormatPtr nullable(const AnyFormatPtr& format,
                                    const OptionalOperations& operations);
template <class T>
[[nodiscard]] FormatPtr<std::optional<T>> nullable(const FormatPtr<T>& format) {
  return FormatPtr<std::optional<T>>(nullable(format->any(), kOptionalOperations<T>));
}

void refuse_choice(const JsonNode& node, const std::string& found,
                   const std::vector<std::string>& known);

// Operations on an enumeration (core/base/enumeration.h) whose values are numbered from zero.
struct ChoiceOperations {
  const char* (*name)(std::size_t value);  // null if the number is no value
  std::size_t (*value)(const void* choice);
  void (*set)(void* choice, std::size_t value);
};
template <class E>
inline constexpr ChoiceOperations kChoiceOperations{
    [](std::size_t value) { return to_string(static_cast<E>(value)); },
    [](const void* choice) { return static_cast<std::size_t>(*static_cast<const E*>(choice)); },
    [](void* choice, std::size_t value) { *static_cast<E*>(choice) = static_cast<E>(value); }};
[[nodiscard]] AnyFormatPtr choice(const ChoiceOperations& operations);
template <class E>
[[nodiscard]] FormatPtr<E> choice() {
  return FormatPtr<E>(choice(kChoiceOperations<E>));
}

// Name a format, so that schemas can refer to it by name. The schema has {"$name", "$of"} until
// refer_to_names() replaces them. `text` may be empty.
[[nodiscard]] Schema named_schema(std::string_view name, std::string_view text, Schema schema);
[[nodiscard]] AnyFormatPtr named(std::string_view name, std::string_view text,
                                 const AnyFormatPtr& format);
template <class T>
[[nodiscard]] FormatPtr<T> named(std::string_view name, std::string_view text,
                                 const FormatPtr<T>& format) {
  return FormatPtr<T>(named(name, text, format->any()));
}

}  // namespace armloom::formats
