#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace armloom {

// An enumeration that is spelt out somewhere has its names in one place: a constexpr to_string()
// with a case for each value, so that the compiler misses none, and null for what is no value. The
// values count from zero.

template <class E>
inline constexpr std::size_t kValueCount = [] {
  std::size_t count = 0;
  while (to_string(static_cast<E>(count)) != nullptr) ++count;
  return count;
}();

// All of them, in their order.
template <class E>
inline constexpr auto kValues = [] {
  std::array<E, kValueCount<E>> values{};
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<E>(i);
  return values;
}();

// The one of this name; nothing: none is.
template <class E>
[[nodiscard]] constexpr std::optional<E> value_named(std::string_view name) {
  for (const E value : kValues<E>) {
    if (name == to_string(value)) return value;
  }
  return std::nullopt;
}

}  // namespace armloom
