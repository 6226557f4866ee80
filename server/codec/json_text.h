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

// Nothing that we read has more in one array, which grows by doubling.
inline constexpr std::size_t kJsonElementsMax = 100'000;

// Arrays, objects, members and strings in all, each of which takes some 100 bytes however short it
// is: a text of nothing but {} would take thirty times its size. Trajectories as dense as they can
// be written have a million in 8 MiB.
inline constexpr std::size_t kJsonPartsMax = 1'200'000;

enum class JsonComments { refused, allowed };

// Reads one JSON text as RFC 8259 has it, more strictly than the library does by itself: NUL bytes,
// keys that occur twice, numbers beyond a double, invalid UTF-8, nesting beyond kJsonDepthMax,
// objects beyond kJsonMembersMax, arrays beyond kJsonElementsMax and texts beyond kJsonPartsMax are
// problems. `comments` allows
// // and /* */ (cell files).
//
// Problem (malformed; too_large for depth, members, elements and parts): the pointer leads to the
// value that could not be read ("/trajectory/points/3/positions/2"), the detail names line and
// column, the value is the text found there ("NaN").
[[nodiscard]] Result<nlohmann::json> parse_json(std::string_view text, JsonComments comments);

}  // namespace armloom
