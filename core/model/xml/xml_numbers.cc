#include "core/model/xml/xml_numbers.h"

#include <charconv>
#include <cmath>

namespace armloom {
namespace {

constexpr std::string_view kWhiteSpace = " \t\r\n";

}  // namespace

std::optional<double> parse_number(std::string_view token) {
  if (token.starts_with('+')) {
    token.remove_prefix(1);
    if (token.starts_with('-')) return std::nullopt;
  }
  double number = 0.0;
  const char* end = token.data() + token.size();
  const auto read = std::from_chars(token.data(), end, number);
  if (read.ec != std::errc{} || read.ptr != end || !std::isfinite(number)) return std::nullopt;
  return number;
}

std::optional<std::vector<double>> parse_numbers(std::string_view text) {
  std::vector<double> numbers;
  for (;;) {
    const auto begin = text.find_first_not_of(kWhiteSpace);
    if (begin == std::string_view::npos) return numbers;
    text.remove_prefix(begin);
    const auto length = std::min(text.find_first_of(kWhiteSpace), text.size());
    const auto number = parse_number(text.substr(0, length));
    if (!number) return std::nullopt;
    numbers.push_back(*number);
    text.remove_prefix(length);
  }
}

}  // namespace armloom
