#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace armloom {

// Names of enumeration values. Each enumeration defines a constexpr to_string() with a case for
// each value; the compiler reports a missing case. For other numbers, to_string() returns nullptr.
// Values count from zero.

template <class E>
inline constexpr std::size_t kValueCount = [] {
  std::size_t count = 0;
  while (to_string(static_cast<E>(count)) != nullptr) ++count;
  return count;
}();

// All values in order.
template <class E>
inline constexpr auto kValues = [] {
  std::array<E, kValueCount<E>> values{};
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<E>(i);
  return values;
}();

// Returns the value of this name, or nullopt if there is none.
template <class E>
[[nodiscard]] constexpr std::optional<E> value_named(std::string_view name) {
  for (const E value : kValues<E>) {
    if (name == to_string(value)) return value;
  }
  return std::nullopt;
}

}  // namespace armloom
