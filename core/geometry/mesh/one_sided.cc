#include "core/geometry/mesh/one_sided.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>

namespace armloom {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

// A triangle regardless of its orientation, and how often it occurs in each orientation.
struct Face {
  std::size_t first;  // index of its first occurrence
  std::array<std::size_t, 2> sides{};
  [[nodiscard]] bool doubled() const { return sides[0] == sides[1]; }
};
using Faces = std::map<Triangle, Face>;

Triangle sorted(Triangle t) {
  std::ranges::sort(t);
  return t;
}

// Returns the orientation: 0 if, starting at the smallest index, the next corner's index is smaller
// than the last corner's, else 1.
std::size_t side_of(const Triangle& t) {
  const auto least = static_cast<std::size_t>(std::ranges::min_element(t) - t.begin());
  return t[(least + 1) % 3] < t[(least + 2) % 3] ? 0 : 1;
}

// Returns true if any triangle occurs twice, in either orientation. A fast test, because in most
// meshes no triangle does.
bool any_twice(const std::vector<Triangle>& triangles) {
  std::vector<Triangle> keys;
  for (const Triangle& t : triangles) keys.push_back(sorted(t));
  std::ranges::sort(keys);
  return std::ranges::adjacent_find(keys) != keys.end();
}

Faces faces_of(const std::vector<Triangle>& triangles) {
  Faces faces;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const Triangle key = sorted(triangles[i]);
    if (key[0] == key[1] || key[1] == key[2]) continue;  // no area, no orientation
    ++faces.try_emplace(key, Face{i}).first->second.sides[side_of(triangles[i])];
  }
  return faces;
}

std::array<Edge, 3> edges_of(const Triangle& key) {
  return {Edge{key[0], key[1]}, Edge{key[0], key[2]}, Edge{key[1], key[2]}};
}

// The doubled faces, each once, after repeated removal of faces with free edges.
class Doubled {
 public:
  explicit Doubled(const Faces& faces) {
    for (const auto& [key, face] : faces) {
      if (!face.doubled()) continue;
      for (const Edge& edge : edges_of(key)) at_[edge].push_back(key);
      left_.emplace(key, true);
    }
    std::vector<Edge> free;
    for (const auto& [edge, keys] : at_) {
      if (keys.size() == 1) free.push_back(edge);
    }
    while (!free.empty()) {
      const Edge edge = free.back();
      free.pop_back();
      if (at_[edge].size() != 1) continue;
      take_off(Triangle(at_[edge].front()), free);
    }
  }

  [[nodiscard]] bool has(const Triangle& key) const {
    const auto at = left_.find(key);
    return at != left_.end() && at->second;
  }
  [[nodiscard]] bool empty() const {
    return std::ranges::none_of(left_, [](const auto& entry) { return entry.second; });
  }
  [[nodiscard]] bool has(const Edge& edge) const {
    const auto at = at_.find(edge);
    return at != at_.end() && !at->second.empty();
  }

 private:
  void take_off(const Triangle& key, std::vector<Edge>& free) {
    left_[key] = false;
    for (const Edge& edge : edges_of(key)) {
      std::erase(at_[edge], key);
      if (at_[edge].size() == 1) free.push_back(edge);
    }
  }

  std::map<Edge, std::vector<Triangle>> at_;
  std::map<Triangle, bool> left_;
};

}  // namespace

std::optional<std::vector<Triangle>> one_sided(std::vector<Triangle> triangles) {
  if (!any_twice(triangles)) return triangles;
  const Faces faces = faces_of(triangles);
  const Doubled doubled(faces);
  if (doubled.empty()) return triangles;
  for (const auto& [key, face] : faces) {
    if (doubled.has(key)) continue;
    for (const Edge& edge : edges_of(key)) {
      if (doubled.has(edge)) return std::nullopt;
    }
  }
  std::vector<Triangle> kept;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const Triangle key = sorted(triangles[i]);
    const bool other_side = doubled.has(key) && faces.at(key).first != i;
    if (!other_side) kept.push_back(triangles[i]);
  }
  return kept;
}

}  // namespace armloom
