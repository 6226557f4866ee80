#include "core/model/doubled_faces.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <numeric>

namespace armloom {
namespace {

Triangle corners_of(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

// The triangles of each component, components by their lowest corner.
std::map<std::uint32_t, std::vector<Triangle>> components_of(const std::vector<Triangle>& triangles,
                                                             std::size_t vertices) {
  std::vector<std::uint32_t> above(vertices);
  std::iota(above.begin(), above.end(), std::uint32_t{0});
  const auto root = [&](std::uint32_t i) {
    while (above[i] != i) i = above[i] = above[above[i]];
    return i;
  };
  for (const Triangle& t : triangles) {
    for (const std::uint32_t corner : {t[1], t[2]}) {
      const auto [low, high] = std::minmax({root(t[0]), root(corner)});
      above[high] = low;
    }
  }
  std::map<std::uint32_t, std::vector<Triangle>> components;
  for (const Triangle& t : triangles) components[root(t[0])].push_back(t);
  return components;
}

// One of each pair, or nothing when there are others.
std::vector<Triangle> halved(const std::vector<Triangle>& triangles) {
  std::map<Triangle, std::size_t> times;
  std::vector<Triangle> kept;
  for (const Triangle& t : triangles) {
    if (times[corners_of(t)]++ == 0) kept.push_back(t);
  }
  const bool paired =
      std::all_of(times.begin(), times.end(), [](const auto& one) { return one.second == 2; });
  return paired ? kept : std::vector<Triangle>{};
}

}  // namespace

std::vector<Triangle> without_doubled_faces(std::vector<Triangle> triangles, std::size_t vertices) {
  std::vector<Triangle> kept;
  for (auto& [root, component] : components_of(triangles, vertices)) {
    const std::vector<Triangle> half = halved(component);
    const bool solid = !half.empty() && is_closed(half);
    const std::vector<Triangle>& taken = solid ? half : component;
    kept.insert(kept.end(), taken.begin(), taken.end());
  }
  return kept.size() == triangles.size() ? std::move(triangles) : kept;
}

}  // namespace armloom
