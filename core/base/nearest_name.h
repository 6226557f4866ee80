#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace armloom {

// Returns the known name that differs in the fewest letters: changed, added, omitted, or swapped
// with a neighbor (optimal string alignment). Returns nullopt if more than a third of its letters
// differ.
[[nodiscard]] std::optional<std::string_view> nearest_name(std::string_view misspelt,
                                                           std::span<const std::string_view> known);

// Returns the key of the map that is nearest to the misspelt name. Returns nullopt if the map is
// large, because many names can be unknown at once and each search takes time.
template <class Map>
[[nodiscard]] std::optional<std::string> nearest_key(const std::string& misspelt,
                                                     const Map& known) {
  constexpr std::size_t kMost = 300;
  if (known.size() > kMost) return std::nullopt;
  std::vector<std::string_view> names;
  for (const auto& entry : known) names.push_back(entry.first);
  const auto nearest = nearest_name(misspelt, names);
  return nearest ? std::optional<std::string>(*nearest) : std::nullopt;
}

// Returns "; did you mean elbow?" with the nearest key, or an empty string.
template <class Map>
[[nodiscard]] std::string did_you_mean(const std::string& misspelt, const Map& known) {
  const auto nearest = nearest_key(misspelt, known);
  return nearest ? "; did you mean " + *nearest + "?" : std::string();
}

}  // namespace armloom
