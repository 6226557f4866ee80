#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace armloom {

// Returns "2026-11-21T09:33:00.125Z"; the argument is in milliseconds since 1970.
[[nodiscard]] std::string rfc3339(std::int64_t since_1970_ms);

// Reads a time with any UTC offset. Drops digits beyond milliseconds. Returns nullopt if the text
// is malformed.
[[nodiscard]] std::optional<std::int64_t> read_rfc3339(std::string_view text);

}  // namespace armloom
