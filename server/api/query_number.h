#pragma once

#include <charconv>
#include <string>
#include <system_error>

namespace armloom {

// Whether all of a parameter's text is a whole number within these bounds, which `out` is then.
template <class Number>
bool read_between(const std::string& text, Number lowest, Number highest, Number& out) {
  Number number{};
  const char* end = text.data() + text.size();
  const auto [stop, ec] = std::from_chars(text.data(), end, number);
  if (ec != std::errc{} || stop != end || number < lowest || number > highest) return false;
  out = number;
  return true;
}

}  // namespace armloom
