#pragma once

#include <charconv>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace armloom {

// Words of a mesh file, with line numbers.
class MeshWords {
 public:
  explicit MeshWords(std::string_view text) : rest_(text) {}

  // Returns the next word; empty at the end.
  [[nodiscard]] std::string_view next();
  void skip_line();
  // Line of the last word, from 1.
  [[nodiscard]] std::size_t line() const { return line_; }

 private:
  std::string_view rest_;
  std::size_t line_ = 1;
};

// Parses a decimal number, nan or inf. Returns infinity if the number is too large for a float, and
// nullopt if the word is not a number.
[[nodiscard]] std::optional<float> float_of(std::string_view word);

// Quotes a word for a message. Long words are shortened, and unprintable characters are replaced.
[[nodiscard]] std::string quoted(std::string_view word);

}  // namespace armloom
