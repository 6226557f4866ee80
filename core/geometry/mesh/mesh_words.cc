#include "core/geometry/mesh/mesh_words.h"

#include <algorithm>
#include <limits>

namespace armloom {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

}  // namespace

std::string_view MeshWords::next() {
  while (!rest_.empty() && (is_blank(rest_.front()) || rest_.front() == '\n')) {
    line_ += rest_.front() == '\n' ? 1 : 0;
    rest_.remove_prefix(1);
  }
  const auto end = std::ranges::find_if(rest_, [](char c) { return is_blank(c) || c == '\n'; });
  const std::string_view word = rest_.substr(0, static_cast<std::size_t>(end - rest_.begin()));
  rest_.remove_prefix(word.size());
  return word;
}

void MeshWords::skip_line() { rest_.remove_prefix(std::min(rest_.find('\n'), rest_.size())); }

std::optional<float> float_of(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  float number = 0.0F;
  const char* end = word.data() + word.size();
  const auto [at, error] = std::from_chars(word.data(), end, number);
  if (at != end || error == std::errc::invalid_argument) return std::nullopt;
  if (error == std::errc{}) return number;
  const auto exponent = word.find_first_of("eE");  // out of range: too small or too large?
  const bool tiny = exponent != word.npos && word.substr(exponent + 1).starts_with('-');
  const bool zero = tiny || word.find_first_not_of("-0") == word.find('.');
  return zero ? 0.0F : std::numeric_limits<float>::infinity();
}

std::string quoted(std::string_view word) {
  std::string text = "'" + std::string(word.substr(0, 40)) + (word.size() > 40 ? "...'" : "'");
  std::ranges::replace_if(
      text, [](char c) { return c < ' ' || c > '~'; }, '?');
  return text;
}

}  // namespace armloom
