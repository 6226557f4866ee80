#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string_view>

#include "core/base/problem.h"

namespace armloom {

// Deeper nesting than this is refused: nothing that we read needs more than eight levels, and the
// library copies and destroys values by recursion.
inline constexpr std::size_t kJsonDepthMax = 32;

// Nothing that we read names more in one object; many in one take time to tell apart.
inline constexpr std::size_t kJsonMembersMax = 10'000;

// Nothing that we read has more in one array: a body of nothing but {} would take a hundred times
// its size.
inline constexpr std::size_t kJsonElementsMax = 100'000;

enum class JsonComments { refused, allowed };

// Reads one JSON text as RFC 8259 has it, more strictly than the library does by itself: NUL bytes,
// keys that occur twice, numbers beyond a double, invalid UTF-8, nesting beyond kJsonDepthMax,
// objects beyond kJsonMembersMax and arrays beyond kJsonElementsMax are problems. `comments` allows
// // and /* */ (cell files).
//
// Problem (malformed; too_large for depth, members and elements): the pointer leads to the value
// that could not be read ("/trajectory/points/3/positions/2"), the detail names line and column,
// the value is the text found there ("NaN").
[[nodiscard]] Result<nlohmann::json> parse_json(std::string_view text, JsonComments comments);

}  // namespace armloom
