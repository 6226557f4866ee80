#pragma once

#include <charconv>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace armloom {

// The words of a mesh file in text, with their lines.
class MeshWords {
 public:
  explicit MeshWords(std::string_view text) : rest_(text) {}

  // The next word; empty at the end.
  [[nodiscard]] std::string_view next();
  // What is left of the line that the last word stands in.
  void skip_line();
  // Of the last word, from 1.
  [[nodiscard]] std::size_t line() const { return line_; }

 private:
  std::string_view rest_;
  std::size_t line_ = 1;
};

// A decimal number, also nan and inf; what is too large for a float is infinite. Nothing: it is
// none, or more than one.
[[nodiscard]] std::optional<float> float_of(std::string_view word);

// 'word' for a message: cut short, and without what would not print.
[[nodiscard]] std::string quoted(std::string_view word);

}  // namespace armloom
