#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/time.h"

namespace armloom {

// Appends `billionths` as a decimal fraction, truncated to `decimals` (3 or 9) places.
void append_fraction(std::string& out, std::int64_t billionths, int decimals);
// Appends the time in seconds, with 3 decimals if it is a whole number of milliseconds, else with
// 9.
void append_seconds(std::string& out, TimePoint time);

[[nodiscard]] std::vector<std::string_view> split_fields(std::string_view line);
// Returns a finite number of magnitude 9e8 at most; nullopt if the field is anything else.
[[nodiscard]] std::optional<double> read_number(std::string_view field);

}  // namespace armloom
