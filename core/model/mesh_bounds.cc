#include "core/model/mesh_bounds.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace armloom {
namespace {

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

constexpr std::size_t kStlHeader = 84;

// 0 of files that end before.
std::uint32_t count_in_stl_header(std::string_view bytes) {
  std::uint32_t count = 0;
  if (bytes.size() >= kStlHeader) std::memcpy(&count, bytes.data() + 80, sizeof count);
  return count;
}

std::size_t words_in(std::string_view text) {
  std::size_t words = 0;
  bool in_word = false;
  for (const char c : text) {
    const bool letter = !is_space(c);
    words += letter && !in_word ? 1U : 0U;
    in_word = letter;
  }
  return words;
}

}  // namespace

bool is_text_stl(std::string_view bytes) {
  std::size_t begin = 0;
  while (begin < bytes.size() && is_space(bytes[begin])) ++begin;
  return bytes.substr(begin).starts_with("solid") &&
         bytes.size() != kStlHeader + std::size_t{50} * count_in_stl_header(bytes);
}

std::size_t most_triangles_of_stl(std::string_view bytes) {
  if (!is_text_stl(bytes)) return count_in_stl_header(bytes);
  std::size_t corners = 0;
  for (auto at = bytes.find("vertex"); at != bytes.npos; at = bytes.find("vertex", at + 6))
    ++corners;
  return corners / 3;
}

std::size_t most_triangles_of_obj(std::string_view bytes) {
  std::size_t triangles = 0;
  while (!bytes.empty()) {
    const std::size_t end = std::min(bytes.find('\n'), bytes.size());
    std::string_view line = bytes.substr(0, end);
    bytes.remove_prefix(std::min(end + 1, bytes.size()));
    while (!line.empty() && is_space(line.front())) line.remove_prefix(1);
    if (line.size() < 2 || line.front() != 'f' || !is_space(line[1])) continue;
    const std::size_t corners = words_in(line.substr(1));
    if (corners > 2) triangles += corners - 2;
  }
  return triangles;
}

}  // namespace armloom
