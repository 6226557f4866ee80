#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace armloom {

// Parse strictly. XML libraries accept "nan", "1e999", "0x10" and "1.5 metres", but a robot must
// not move by a guess.

// Returns a finite decimal number, with an optional leading +. Returns nullopt for empty,
// hexadecimal, nan, inf, overflow or trailing text.
[[nodiscard]] std::optional<double> parse_number(std::string_view token);

// Returns numbers separated by white space, or nullopt if any is invalid.
[[nodiscard]] std::optional<std::vector<double>> parse_numbers(std::string_view text);

}  // namespace armloom
