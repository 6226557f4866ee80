#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace armloom {

// Returns the wall time as RFC 3339 in UTC with milliseconds, "2026-11-21T09:33:00.125Z". The
// argument is in milliseconds since 1970.
[[nodiscard]] std::string rfc3339(std::int64_t since_1970_ms);

// Reads an RFC 3339 time with any offset; drops digits beyond milliseconds. Returns nullopt if the
// text is not such a time.
[[nodiscard]] std::optional<std::int64_t> read_rfc3339(std::string_view text);

}  // namespace armloom
