#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace armloom {

// Strict parsers. XML libraries accept "nan", "1e999", "0x10" and "1.5 metres", but a robot must
// not move to a guessed position.

// Returns a finite decimal number, with an optional leading +. Returns nullopt if the token is
// empty, hexadecimal, nan, inf, too large, or has other text after the number.
[[nodiscard]] std::optional<double> parse_number(std::string_view token);

// Returns numbers separated by white space, or nullopt if any is invalid.
[[nodiscard]] std::optional<std::vector<double>> parse_numbers(std::string_view text);

}  // namespace armloom
