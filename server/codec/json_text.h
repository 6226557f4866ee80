#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string_view>

#include "core/base/problem.h"

namespace armloom {

// Maximum nesting. Our formats need at most eight levels, and the library copies and destroys
// values recursively.
inline constexpr std::size_t kJsonDepthMax = 32;

// Maximum members of one object; more would take long to tell apart.
inline constexpr std::size_t kJsonMembersMax = 10'000;

// Maximum elements of one array, which grows by doubling.
inline constexpr std::size_t kJsonElementsMax = 100'000;

// Maximum number of arrays, objects, members and strings together. Each takes about 100 bytes,
// however short: a text of {} alone would take thirty times its size. The densest trajectories have
// a million in 8 MiB.
inline constexpr std::size_t kJsonPartsMax = 1'200'000;

enum class JsonComments { refused, allowed };

// Reads one JSON text (RFC 8259). Stricter than the library: refuses NUL bytes, duplicate keys,
// numbers beyond a double, invalid UTF-8, and texts beyond the limits above. `comments` allows //
// and /* */ (cell files).
//
// Problem (malformed; too_large for the limits): the pointer leads to the value that could not be
// read ("/trajectory/points/3/positions/2"), the detail names line and column, the value is the
// text found there ("NaN").
[[nodiscard]] Result<nlohmann::json> parse_json(std::string_view text, JsonComments comments);

}  // namespace armloom
