#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string_view>

#include "core/base/problem.h"

namespace armloom {

// Maximum nesting of arrays and objects. Formats of Armloom need eight levels. A limit is needed
// because the JSON library copies values recursively.
inline constexpr std::size_t kJsonDepthMax = 32;

// Maximum number of members of one object.
inline constexpr std::size_t kJsonMembersMax = 10'000;

// Maximum number of elements of one array.
inline constexpr std::size_t kJsonElementsMax = 100'000;

// Maximum number of arrays, objects, members and strings in a text; each takes about 100 bytes. The
// densest trajectories have a million of them in 8 MiB.
inline constexpr std::size_t kJsonPartsMax = 1'200'000;

enum class JsonComments { refused, allowed };

// Reads one JSON text (RFC 8259). Refuses NUL bytes, duplicate keys, numbers beyond a double,
// invalid UTF-8, and texts beyond these limits.
//
// Problem (malformed, or too_large beyond a limit): the pointer leads to the unreadable value
// ("/trajectory/points/3/positions/2"). The detail names line and column; the value is the text
// found ("NaN").
[[nodiscard]] Result<nlohmann::json> parse_json(std::string_view text, JsonComments comments);

}  // namespace armloom
