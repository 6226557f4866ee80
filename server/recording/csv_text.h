#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/time.h"

namespace armloom {

// `billionths` as a decimal fraction with `decimals` (3 or 9) places, the rest cut off.
void append_fraction(std::string& out, std::int64_t billionths, int decimals);
// Seconds, in whole milliseconds where that is all there is.
void append_seconds(std::string& out, TimePoint time);

[[nodiscard]] std::vector<std::string_view> split_fields(std::string_view line);
// A finite number of magnitude 9e8 at most, and nothing else.
[[nodiscard]] std::optional<double> read_number(std::string_view field);

}  // namespace armloom
