#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace armloom {

// The known name that a misspelt one most likely means: the fewest letters changed, added, left out
// or swapped with a neighbour (optimal string alignment), at most a third of them. None: nothing is
// near.
[[nodiscard]] std::optional<std::string_view> nearest_name(std::string_view misspelt,
                                                           std::span<const std::string_view> known);

// The same of the keys of a map. Only where there are few of them: many names can be unknown at
// once.
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

// "; did you mean elbow?", of the keys of a map, or nothing.
template <class Map>
[[nodiscard]] std::string did_you_mean(const std::string& misspelt, const Map& known) {
  const auto nearest = nearest_key(misspelt, known);
  return nearest ? "; did you mean " + *nearest + "?" : std::string();
}

}  // namespace armloom
