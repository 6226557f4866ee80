#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace armloom {

// Parse numbers in XML attributes strictly. XML libraries accept "nan", "1e999", "0x10" and "1.5
// metres", but a robot must not move by a guess.

// Returns the whole token as a finite decimal number, with an optional leading +. Returns nullopt
// if it is empty, hexadecimal, nan, inf, too large, or followed by other text.
[[nodiscard]] std::optional<double> parse_number(std::string_view token);

// Returns finite numbers separated by white space, or nullopt if any is not a number.
[[nodiscard]] std::optional<std::vector<double>> parse_numbers(std::string_view text);

}  // namespace armloom
