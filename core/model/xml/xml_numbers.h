#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace armloom {

// Numbers in XML attributes, read strictly. The XML libraries underneath read "nan", "1e999",
// "0x10" and "1.5 metres" as some number or other; a robot must not move by a guess.

// The whole token as a finite decimal number; a leading + is allowed. Empty, hexadecimal, nan, inf,
// overflow and trailing text give nothing.
[[nodiscard]] std::optional<double> parse_number(std::string_view token);

// Finite numbers separated by white space; nothing when one of them is not a number.
[[nodiscard]] std::optional<std::vector<double>> parse_numbers(std::string_view text);

}  // namespace armloom
