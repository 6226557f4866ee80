#include "server/http/entity_tag.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>

namespace armloom {

std::string tag_of(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325U;  // FNV-1a
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  char text[40];
  std::snprintf(text, sizeof text, "%zx-%016llx", bytes.size(),
                static_cast<unsigned long long>(hash));
  return text;
}

namespace {

void skip(std::string_view& text, std::string_view what) {
  text.remove_prefix(std::min(text.size(), text.find_first_not_of(what)));
}

bool take_tag(std::string_view& text) {
  if (text.starts_with("W/")) text.remove_prefix(2);
  if (!text.starts_with('"')) return false;
  const std::size_t end = text.find('"', 1);
  if (end == text.npos) return false;
  const bool is_sound = std::ranges::all_of(text.substr(1, end - 1),
                                            [](unsigned char c) { return c > 0x20 && c != 0x7f; });
  text.remove_prefix(end + 1);
  return is_sound;
}

}  // namespace

bool is_tag_list(std::string_view field) {
  static constexpr std::string_view kBetween = ", \t";
  skip(field, kBetween);
  if (field == "*") return true;
  bool has_tag = false;
  for (; !field.empty(); skip(field, kBetween)) {
    if (!take_tag(field)) return false;
    has_tag = true;
    skip(field, " \t");
    if (!field.empty() && !field.starts_with(',')) return false;
  }
  return has_tag;
}

bool any_tag(std::string_view field, const std::function<bool(std::string_view)>& fits) {
  while (!field.empty()) {
    std::string_view one = field.substr(0, field.find(','));
    field.remove_prefix(std::min(field.size(), one.size() + 1));
    while (one.starts_with(' ') || one.starts_with('\t')) one.remove_prefix(1);
    while (one.ends_with(' ') || one.ends_with('\t')) one.remove_suffix(1);
    if (fits(one)) return true;
  }
  return false;
}

}  // namespace armloom
