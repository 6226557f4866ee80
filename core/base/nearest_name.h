#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace armloom {

// The known name that a misspelt one most likely means: the fewest letters changed, added, left out
// or swapped with a neighbour (optimal string alignment), at most a third of them. None: nothing is
// near.
[[nodiscard]] std::optional<std::string_view> nearest_name(std::string_view misspelt,
                                                           std::span<const std::string_view> known);

}  // namespace armloom
