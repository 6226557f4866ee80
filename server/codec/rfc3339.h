#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace armloom {

// Wall time as people and programs are told it: RFC 3339 in UTC with milliseconds,
// "2026-11-21T09:33:00.125Z". Milliseconds since 1970.
[[nodiscard]] std::string rfc3339(std::int64_t since_1970_ms);

// Of any offset, with any digits of a second (those beyond milliseconds are dropped). Nothing: it
// is no such time.
[[nodiscard]] std::optional<std::int64_t> read_rfc3339(std::string_view text);

}  // namespace armloom
